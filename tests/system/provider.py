"""An identity provider for tests, which signs JSON Web Tokens."""

import base64
import json
import pathlib
import subprocess
import time

from contactd import PATIENCE_S


def base64url(data):
    return base64.urlsafe_b64encode(data).rstrip(b"=").decode()


class Provider:
    """An identity provider with an Ed25519 key, made by openssl."""

    def __init__(self, folder, kid):
        self.kid, self.key = kid, pathlib.Path(folder) / f"{kid}.key"
        self._openssl("genpkey", "-algorithm", "ed25519", "-out", self.key)

    def jwk(self):
        public = self._openssl("pkey", "-in", self.key, "-pubout", "-outform", "DER")
        return {"kty": "OKP", "crv": "Ed25519", "kid": self.kid, "use": "sig",
                "x": base64url(public[-32:])}

    def token(self, **changes):
        claims = {"iss": "https://id.acme", "aud": "contactd", "exp": time.time() + 60,
                  "sub": "ada", "tenant": "acme", "roles": ["submit"], **changes}
        text = ".".join(base64url(json.dumps(part).encode())
                        for part in ({"alg": "EdDSA", "kid": self.kid}, claims))
        message = self.key.with_suffix(".message")
        message.write_text(text)
        signature = self._openssl("pkeyutl", "-sign", "-rawin", "-inkey", self.key, "-in", message)
        return f"{text}.{base64url(signature)}"

    @staticmethod
    def _openssl(*arguments):
        return subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True,
                              timeout=PATIENCE_S).stdout
