"""What `kubectl kustomize` builds of deploy/kubernetes, and how its objects hang together."""

import functools
import pathlib
import subprocess

import yaml
from tools import tool

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "deploy/kubernetes"
NAMES = ["base", *(f"overlays/{path.name}" for path in sorted((FOLDER / "overlays").iterdir()))]


@functools.cache
def _built(name):
    text = subprocess.run([tool("kubectl"), "kustomize", FOLDER / name], check=True, timeout=60,
                          capture_output=True, text=True).stdout
    return list(yaml.safe_load_all(text))


def objects(name, *kinds):
    """The objects of base or an overlay, of these kinds or all."""
    return [thing for thing in _built(name) if not kinds or thing["kind"] in kinds]


def workloads(name):
    """The objects that make pods."""
    return objects(name, "Deployment", "Job")


def pod(workload):
    return workload["spec"]["template"]["spec"]


def containers(name):
    """(pod, container) of all workloads."""
    return [(pod(workload), container) for workload in workloads(name)
            for container in pod(workload)["containers"]]


def labels(workload):
    return workload["spec"]["template"]["metadata"]["labels"]


def chosen(name, selector):
    """The workloads whose pods have the labels of a selector."""
    wanted = selector.get("matchLabels", {}).items()
    return [workload for workload in workloads(name) if wanted <= labels(workload).items()]


def ports(workload):
    """The names of the ports of its pods."""
    return {port["name"] for container in pod(workload)["containers"]
            for port in container.get("ports", [])}


def fewest(name, workload):
    """How many of its pods there are at the least; 0 if nobody says it."""
    for scaler in objects(name, "HorizontalPodAutoscaler", "ScaledObject"):
        if scaler["spec"]["scaleTargetRef"]["name"] == workload["metadata"]["name"]:
            return scaler["spec"].get("minReplicas", scaler["spec"].get("minReplicaCount", 0))
    return workload["spec"].get("replicas", 0)
