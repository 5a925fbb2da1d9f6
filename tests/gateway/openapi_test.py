"""The OpenAPI document of the gateway is that of the contract: it has every route and none other, is valid,
and requests and answers keep to it."""

import json
import pathlib
import re
import unittest

import jsonschema
from contact.v1 import admin_service_pb2, job_service_pb2, model_service_pb2
from contactd import endless, three_ball_chain
from gateway import SERVICE, GatewayTest

ROOT = pathlib.Path(__file__).parents[2]
VERBS = {"get", "post"}
PLAIN = {"/healthz", "/readyz", "/metrics", "/v1/openapi.json"}
HEALTH = {"/grpc.health.v1.Health/Check", "/grpc.health.v1.Health/Watch"}


def examples(page):
    """Pairs of a method and a request that a page shows for it."""
    for block in re.findall(r"^```sh run\n(.*?)^```$", page, re.S | re.M):
        block = re.sub(r"^cat > \w+\.py <<'END'\n.*?^END$", "", block, flags=re.S | re.M)
        called = re.search(r"\$url/(\w+)", block)
        if called is None:
            continue
        method = called[1]
        text = block.replace('\\"', '"').replace("$(cat name)", "jobs/abcdefghij")
        place = text.find("{")
        while place >= 0:
            try:
                request, end = json.JSONDecoder().raw_decode(text, place)
                yield method, request
            except ValueError:
                end = place + 1
            place = text.find("{", end)


class OpenApiTest(GatewayTest):

    def setUp(self):
        super().setUp()
        answer = self.ask("GET", "/v1/openapi.json")
        self.assertEqual((answer.status, answer.headers["content-type"]), (200, "application/json"))
        self.document = answer.json()

    def operations(self):
        return [(path, verb, operation) for path, verbs in self.document["paths"].items()
                for verb, operation in verbs.items()]

    def check(self, schema, value):
        """Fails unless the value keeps to the schema of this name, or to this schema."""
        whole = {**({"$ref": f"#/components/schemas/{schema}"} if isinstance(schema, str) else schema),
                 "components": self.document["components"]}
        jsonschema.Draft202012Validator(whole).validate(value)

    def test_document_is_valid(self):
        document = self.document
        self.assertEqual(document["openapi"], "3.1.0")
        self.assertRegex(document["info"]["version"], r"^\d+\.\d+\.\d+$")
        self.assertTrue(document["info"]["title"])
        for name, schema in document["components"]["schemas"].items():
            jsonschema.Draft202012Validator.check_schema(schema)
            self.assertRegex(name, r"^[A-Za-z0-9._-]+$")
            self.assertTrue(schema.get("description"), name)
        for ref in re.findall(r'"\$ref": "#/(.*?)"', json.dumps(document)):
            part = document
            for step in ref.split("/"):
                self.assertIn(step, part, ref)
                part = part[step]
        ids = [operation["operationId"] for _, _, operation in self.operations()]
        self.assertEqual(len(ids), len(set(ids)))
        for path, verb, operation in self.operations():
            self.assertIn(verb, VERBS)
            self.assertTrue(operation["summary"], path)
            self.assertTrue(operation["responses"], path)
            self.assertEqual("requestBody" in operation, verb == "post")
            for parameter in operation.get("parameters", []):
                if "$ref" not in parameter:
                    self.assertIn(parameter["in"], ("query", "header"))
                    self.assertEqual(len({"schema", "content"} & set(parameter)), 1)

    def test_document_has_every_route_and_none_other(self):
        services = [service for module in (job_service_pb2, admin_service_pb2, model_service_pb2)
                    for service in module.DESCRIPTOR.services_by_name.values()]
        methods = {f"/{service.full_name}/{method.name}": method
                   for service in services for method in service.methods}
        self.assertEqual(set(self.document["paths"]), set(methods) | PLAIN | HEALTH)
        for path, verbs in self.document["paths"].items():
            allowed = self.ask("OPTIONS", path, headers={"origin": f"http://127.0.0.1:{self.http}"})
            said = set(allowed.headers["allow"].lower().split(", ")) & VERBS
            self.assertEqual(set(verbs), said, path)
            if path in PLAIN:
                answer = self.ask("GET", path)
                self.assertIn(str(answer.status), verbs["get"]["responses"], path)
                self.assertNotIn("html", answer.headers["content-type"], path)
        for name in ("message", "encoding"):
            get = self.document["paths"][SERVICE + "GetSeries"]["get"]
            self.assertIn(name, [parameter.get("name") for parameter in get["parameters"]])

    def test_schemas_have_every_field_of_the_contract(self):
        for module in (job_service_pb2, admin_service_pb2, model_service_pb2):
            for name, message in module.DESCRIPTOR.message_types_by_name.items():
                schema = self.document["components"]["schemas"][name]
                self.assertEqual(set(schema["properties"]), {f.json_name for f in message.fields})

    def test_requests_of_the_page_for_curl_keep_to_it(self):
        found = list(examples((ROOT / "client" / "curl.md").read_text("utf-8")))
        self.assertEqual({method for method, _ in found},
                         {"GetServerInfo", "CreateJob", "WatchJob", "GetJob", "GetSeries", "ReadArtifact",
                          "TranslateModel"})
        for method, request in found:
            with self.subTest(method=method):
                self.check(f"{method}Request", request)

    def test_what_breaks_a_rule_does_not_keep_to_it(self):
        good = next(request for method, request in
                    examples((ROOT / "client" / "curl.md").read_text("utf-8")) if method == "CreateJob")
        scenario = good["job"]["scenario"]
        for change in ({"endTimeS": -1}, {"bodies": []}, {"title": "x" * 201}, {"unknown": 1},
                       {"contacts": [{**scenario["contacts"][0], "restitution": 1.2}]}):
            wrong = {"job": {"scenario": {**scenario, **change}}}
            with self.subTest(change=change), self.assertRaises(jsonschema.ValidationError):
                self.check("CreateJobRequest", wrong)
        for job in ({}, {"scenario": scenario, "sweep": {}}):
            with self.assertRaises(jsonschema.ValidationError):
                self.check("CreateJobRequest", {"job": job})

    def test_answers_keep_to_it(self):
        def call(method, **request):
            self.check(f"{method}Request", request)
            answer = self.ask("POST", SERVICE + method, json.dumps(request),
                              {"content-type": "application/json"})
            responses = self.document["paths"][SERVICE + method]["post"]["responses"]
            if answer.status != 200:
                self.check("Error", answer.json())
            else:
                self.check(responses["200"]["content"]["application/json"]["schema"], answer.json())
            return answer.json()

        run = self.server.run(three_ball_chain()).name
        waits = self.server.create(endless()).name
        job = call("GetJob", name=run)
        self.assertEqual(job["state"], "SUCCEEDED")
        self.assertEqual(len(call("ListJobs", pageSize=10)["jobs"]), 2)
        call("GetSeries", name=run, channels=["B1.velocity"], maxPoints=5, plainNumbers=True)
        call("GetServerInfo")
        self.assertEqual(call("GetJob", name="jobs/none")["code"], "not_found")
        noted = call("UpdateJob", job={**job, "note": "good"}, updateMask="labels,note")
        self.assertEqual(noted["note"], "good")
        call("UpdateJob", job={**job, "note": ""}, updateMask="*")
        self.assertEqual(call("DeleteJob", name=waits)["code"], "failed_precondition")
        call("CancelJob", name=waits)
        call("DeleteJob", name=run)
        estimate = call("CreateJob", job={"scenario": job["scenario"]}, validateOnly=True)
        self.assertIn("estimate", estimate)


if __name__ == "__main__":
    unittest.main()
