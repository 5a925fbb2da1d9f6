"""Base and overlays of deploy/kubernetes are what Kubernetes takes, and what contactd is."""

import copy
import math
import unittest

import schemas
from flags import unknown
from kustomize import (NAMES, chosen, containers, fewest, labels, objects, pod, ports, workloads)

SECURITY = {
    "runAsNonRoot": True,
    "readOnlyRootFilesystem": True,
    "allowPrivilegeEscalation": False,
    "capabilities": {"drop": ["ALL"]},
    "seccompProfile": {"type": "RuntimeDefault"},
}
ENDS_WITHIN_S = 5  # contactd, after SIGTERM.
PROBES = ("startupProbe", "livenessProbe", "readinessProbe")


def evicted(budget, replicas):
    """How many of so many pods a budget lets go at once."""
    most = budget["spec"]["maxUnavailable"]
    return math.ceil(replicas * int(most[:-1]) / 100) if isinstance(most, str) else most


def each(make):
    """Pairs of an overlay and one of the things that `make` makes of it."""
    return [(name, thing) for name in NAMES for thing in make(name)]


def deployments(name):
    return objects(name, "Deployment")


class KustomizeTest(unittest.TestCase):

    def test_schemas_allow_every_object(self):
        everything = [thing for name in NAMES for thing in objects(name)]
        self.assertEqual(schemas.mistakes("kubernetes.mjs", everything), [])

    def test_schemas_refuse_what_they_do_not_know(self):
        wrong = copy.deepcopy(objects("base", "Service"))
        wrong[0]["spec"]["ports"][0]["prot"] = 1
        self.assertEqual(schemas.mistakes("kubernetes.mjs", wrong),
                         ["Service contactd: /spec/ports/0/prot: unknown field"])

    def test_containers_have_no_rights(self):
        for _, (_, container) in each(containers):
            self.assertLessEqual(SECURITY.items(), container["securityContext"].items())
            self.assertIn("memory", container["resources"]["limits"])

    def test_pods_cannot_ask_the_cluster(self):
        for name, workload in each(workloads):
            accounts = {account["metadata"]["name"]: account
                        for account in objects(name, "ServiceAccount")}
            account = accounts[pod(workload)["serviceAccountName"]]
            self.assertIs(account["automountServiceAccountToken"], False)
            self.assertIs(pod(workload)["automountServiceAccountToken"], False)

    def test_arguments_are_flags_of_contactd(self):
        for _, (_, container) in each(containers):
            names = [variable["name"] for variable in container["env"]]
            settings = [name.replace("CONTACTD_", "--", 1).replace("_", "-").lower()
                        for name in names if name.startswith("CONTACTD_")]
            self.assertEqual(unknown(container["args"] + settings), [])

    def test_secrets_come_as_files(self):
        for _, (_, container) in each(containers):
            store = next(word for word in container["args"] if word.startswith("--store="))
            self.assertEqual(store, "--store=postgresql:///?service=contactd")
            self.assertIn("PGSERVICEFILE", [variable["name"] for variable in container["env"]])

    def test_files_of_flags_are_in_a_volume(self):
        for _, (spec, container) in each(containers):
            volumes = {volume["name"] for volume in spec["volumes"]}
            mounts = {mount["mountPath"]: mount for mount in container["volumeMounts"]}
            values = [variable["value"] for variable in container["env"]]
            values += [word.split("=", 1)[1] for word in container["args"] if "=" in word]
            for value in (value for value in values if value.startswith("/")):
                self.assertTrue(value in mounts or value.rsplit("/", 1)[0] in mounts, value)
            self.assertLessEqual({mount["name"] for mount in mounts.values()}, volumes)

    def test_only_the_folder_of_state_can_be_written(self):
        for _, (_, container) in each(containers):
            self.assertEqual([mount["mountPath"] for mount in container["volumeMounts"]
                              if not mount.get("readOnly")], ["/var/lib/contactd"])

    def test_probes_ask_ports_that_are_there(self):
        for _, (_, container) in each(containers):
            own = {port["name"] for port in container.get("ports", [])}
            for probe in (container[kind] for kind in PROBES if kind in container):
                self.assertIn(probe["httpGet"]["port"], own)

    def test_deployments_have_probes(self):
        for name, workload in each(deployments):
            for container in pod(workload)["containers"]:
                self.assertLessEqual({"startupProbe", "livenessProbe"}, container.keys())

    def test_deployments_choose_their_own_pods_alone(self):
        for name, workload in each(deployments):
            self.assertEqual(chosen(name, workload["spec"]["selector"]), [workload])

    def test_service_leads_to_ports_of_fronts(self):
        for name, service in each(lambda name: objects(name, "Service")):
            [front] = chosen(name, {"matchLabels": service["spec"]["selector"]})
            asked = {port["targetPort"] for port in service["spec"]["ports"]}
            self.assertLessEqual(asked, ports(front))

    def test_policies_are_about_pods_that_are_there(self):
        for name, policy in each(lambda name: objects(name, "NetworkPolicy")):
            about = chosen(name, policy["spec"]["podSelector"])
            self.assertTrue(about)
            named = {port["port"] for rule in policy["spec"].get("ingress", [])
                     for port in rule["ports"]}
            self.assertLessEqual(named, set().union(*map(ports, about)))

    def test_nobody_reaches_what_no_policy_names(self):
        for name in NAMES:
            nothing = {"podSelector": {}, "policyTypes": ["Ingress", "Egress"]}
            policies = [policy["spec"] for policy in objects(name, "NetworkPolicy")]
            self.assertIn(nothing, policies, name)

    def test_scalers_scale_workers(self):
        for name, scaler in each(
                lambda name: objects(name, "HorizontalPodAutoscaler", "ScaledObject")):
            [worker] = [workload for workload in deployments(name)
                        if workload["metadata"]["name"] == scaler["spec"]["scaleTargetRef"]["name"]]
            self.assertEqual(labels(worker)["app.kubernetes.io/component"], "worker")
            self.assertNotIn("replicas", worker["spec"])  # Each apply would set it back.

    def test_there_is_a_thread_and_a_processor_for_each_job_that_keda_sees(self):
        [worker] = [container for _, container in containers("overlays/keda")
                    if container["name"] == "worker"]
        [threads] = [variable["value"] for variable in worker["env"]
                     if variable["name"] == "CONTACTD_WORKERS"]
        [scaler] = objects("overlays/keda", "ScaledObject")
        self.assertEqual(scaler["spec"]["triggers"][0]["metadata"]["targetQueryValue"], threads)
        self.assertEqual(worker["resources"]["requests"]["cpu"], threads)

    def test_emptying_a_node_takes_one_and_leaves_one(self):
        for name, budget in each(lambda name: objects(name, "PodDisruptionBudget")):
            [workload] = chosen(name, budget["spec"]["selector"])
            replicas = fewest(name, workload)
            self.assertGreaterEqual(evicted(budget, max(replicas, 1)), 1)
            if replicas > 1:
                self.assertLess(evicted(budget, replicas), replicas)

    def test_there_are_as_many_fronts_as_before_while_they_are_replaced(self):
        for name in NAMES:
            [update] = [workload["spec"]["strategy"]["rollingUpdate"]
                        for workload in deployments(name) if "grpc" in ports(workload)]
            self.assertEqual(update["maxUnavailable"], 0)

    def test_pods_have_the_time_that_contactd_needs_to_end(self):
        for _, workload in each(deployments):
            [container] = pod(workload)["containers"]
            hook = container.get("lifecycle", {}).get("preStop", {"sleep": {"seconds": 0}})
            self.assertGreater(pod(workload)["terminationGracePeriodSeconds"],
                               hook["sleep"]["seconds"] + ENDS_WITHIN_S)


if __name__ == "__main__":
    unittest.main()
