"""Makes certificates with openssl, for tests; nothing of it is kept."""

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

    def _new_key(self, name):
        return ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                self.folder / f"{name}.key")

    @staticmethod
    def _openssl(*arguments):
        subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True)
