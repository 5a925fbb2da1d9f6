"""JSON Web Tokens of an identity provider, whose keys are a file."""

import json
import time
import unittest

import grpc
from contact.v1 import job_service_pb2
from contactd import PATIENCE_S, Server, ServerTest, wait_for
from provider import Provider


class JwtTest(ServerTest):

    def make_server(self):
        self.provider = Provider(self.folder, "first")
        self.write_keys(self.provider)
        return Server(self.folder / "data", f"--listen=unix:{self.folder}/socket",
                      f"--jwt-keys={self.folder}/keys", "--jwt-issuer=https://id.acme",
                      "--jwt-audience=contactd", f"--audit-log={self.folder}/audit")

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
        wait_for(lambda: self.knows(second))
        wait_for(lambda: '"keys"' in (self.folder / "audit").read_text())
        lines = (self.folder / "audit").read_text().splitlines()
        changes = [line for line in map(json.loads, lines) if line["method"] == "keys"]
        self.assertEqual([(line["code"], line["peer"]) for line in changes],
                         [("CHANGED", f"file:{self.folder}/keys")])

    def knows(self, provider):
        try:
            return self.caller(provider.token()).name == "ada"
        except grpc.RpcError:
            return False


if __name__ == "__main__":
    unittest.main()
