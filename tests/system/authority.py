"""Makes certificates with openssl, for tests; nothing of it is kept."""

import datetime
import pathlib
import subprocess


class Authority:
    """A certificate authority in a folder. Files: NAME.pem and NAME.key."""

    def __init__(self, folder, name="ca"):
        self.folder, self.name = pathlib.Path(folder), name
        self._openssl("req", "-x509", *self._new_key(name), "-days", "2", "-subj", f"/CN={name}",
                      "-out", self.pem)

    @property
    def pem(self):
        return self.folder / f"{self.name}.pem"

    def issue(self, name, names, days=2):
        """A certificate with these subject alternative names; negative `days`: it has expired."""
        request, extensions = self.folder / f"{name}.csr", self.folder / f"{name}.ext"
        extensions.write_text(f"subjectAltName={names}\n")
        self._openssl("req", *self._new_key(name), "-subj", f"/CN={name}", "-out", request)
        self._openssl("x509", "-req", "-in", request, "-CA", self.pem, "-CAkey",
                      self.folder / f"{self.name}.key", "-CAcreateserial", "-days", str(days),
                      "-extfile", extensions, "-out", self.folder / f"{name}.pem")
        return self.folder / f"{name}.pem", self.folder / f"{name}.key"

    def revoke(self, *names, days=2):
        """The list of the certificates that are revoked, those before and these; negative `days`:
        it is over."""
        database, settings = self.folder / "index.txt", self.folder / "ca.cnf"
        database.touch()
        settings.write_text(f"[ca]\ndefault_ca=it\n[it]\ndatabase={database}\ndefault_md=sha256\n"
                            f"certificate={self.pem}\nprivate_key={self.folder / self.name}.key\n")
        for name in names:
            self._openssl("ca", "-config", settings, "-revoke", self.folder / f"{name}.pem")
        crl = self.folder / "crl.pem"
        begin = datetime.datetime.utcnow() - datetime.timedelta(days=3)
        end = datetime.datetime.utcnow() + datetime.timedelta(days=days)
        self._openssl("ca", "-config", settings, "-gencrl", "-crl_lastupdate", f"{begin:%y%m%d%H%M%SZ}",
                      "-crl_nextupdate", f"{end:%y%m%d%H%M%SZ}", "-out", crl)
        return crl

    def _new_key(self, name):
        return ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                self.folder / f"{name}.key")

    @staticmethod
    def _openssl(*arguments):
        subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True)
