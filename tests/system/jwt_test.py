"""JSON Web Tokens of an identity provider, whose keys are a file."""

import base64
import json
import pathlib
import subprocess
import time
import unittest

import grpc
from contact.v1 import job_service_pb2
from contactd import PATIENCE_S, Server, ServerTest


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


class JwtTest(ServerTest):

    def make_server(self):
        self.provider = Provider(self.folder, "first")
        self.write_keys(self.provider)
        return Server(self.folder / "data", f"--listen=unix:{self.folder}/socket",
                      f"--jwt-keys={self.folder}/keys", "--jwt-issuer=https://id.acme",
                      "--jwt-audience=contactd")

    def write_keys(self, *providers):
        draft = self.folder / "keys.new"
        draft.write_text(json.dumps({"keys": [provider.jwk() for provider in providers]}))
        draft.rename(self.folder / "keys")

    def caller(self, token):
        metadata = [("authorization", f"Bearer {token}")] if token else []
        return self.server.stub.GetServerInfo(job_service_pb2.GetServerInfoRequest(),
                                              timeout=PATIENCE_S, metadata=metadata).principal

    def assertUnknown(self, token):
        with self.assertRaises(grpc.RpcError) as refused:
            self.caller(token)
        self.assertEqual(refused.exception.code(), grpc.StatusCode.UNAUTHENTICATED)
        if token:
            self.assertNotIn(token[-20:], refused.exception.details() + self.server.log())

    def test_holder_is_who_the_token_says(self):
        principal = self.caller(self.provider.token())
        self.assertEqual((principal.name, principal.tenant, principal.how), ("ada", "acme", "jwt"))
        self.assertEqual(list(principal.roles), ["submit"])

    def test_others_are_unknown(self):
        forged = Provider(self.folder, "forged")
        forged.kid = "first"
        for token in (None, "ctk_abcdefgh_secret", self.provider.token(exp=time.time() - 60),
                      self.provider.token(aud="other"), forged.token()):
            self.assertUnknown(token)

    def test_new_keys_of_the_provider_are_taken_while_it_runs(self):
        second = Provider(self.folder, "second")
        self.assertUnknown(second.token())
        self.write_keys(second)
        end = time.monotonic() + PATIENCE_S
        while True:
            try:
                return self.assertEqual(self.caller(second.token()).name, "ada")
            except grpc.RpcError:
                self.assertLess(time.monotonic(), end)
                time.sleep(0.1)


if __name__ == "__main__":
    unittest.main()
