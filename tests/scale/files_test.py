"""The files of docs/scale as their engines would run them: each is parsed, its commands run in a shell with the variables that the
engine sets, once a part and once for the merge, and the merged run is held against the unsharded one.

    files_test.py CROSSRAY SOURCE       exit code 77: cannot be checked here, with the reason
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: there is no YAML parser (Debian: python3-yaml)")
    sys.exit(77)

CROSSRAY = pathlib.Path(sys.argv[1]).resolve()
SOURCE = pathlib.Path(sys.argv[2]).resolve()
FILES = SOURCE / "docs/scale"
ARGUMENTS = "planar/proxy_sphere reflection/proxy_sphere_room refraction/sphere_turns_the_scene_over --backend cpu64"


def load(name):
    with open(FILES / name, encoding="utf-8") as file:
        return list(yaml.safe_load_all(file))


def run(script, folder, shell, **variables):
    environment = dict(os.environ, CROSSRAY_CASES=str(SOURCE / "cases"), PATH=f"{folder}/bin:{os.environ['PATH']}", **variables)
    done = subprocess.run([*shell, script], cwd=folder, env=environment, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"FAIL: {script}\nexit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def make_workspace(folder):
    """A checkout as the commands see it: ./run has built, the package is installed."""
    (folder / "bin").mkdir()
    (folder / "build").mkdir()
    for place in (folder / "bin/crossray", folder / "build/crossray"):
        place.symlink_to(CROSSRAY)
    for place in (folder / "run", folder / "bin/apt-get", folder / "bin/cpack"):
        place.write_text("#!/bin/sh\nexit 0\n")
        place.chmod(0o755)


def check_gitlab(folder):
    (pipeline,) = load("gitlab-ci.yml")
    jobs = {name: job for name, job in pipeline.items() if isinstance(job, dict) and "script" in job}
    assert sorted(jobs) == ["build", "cases", "report"], sorted(jobs)
    assert [jobs[name]["stage"] for name in ("build", "cases", "report")] == pipeline["stages"]
    hidden = pipeline[".crossray"]
    assert jobs["cases"]["extends"] == jobs["report"]["extends"] == ".crossray"
    total = jobs["cases"]["parallel"]
    shell = ["bash", "-eo", "pipefail", "-c"]  # as GitLab's runner does
    run("\n".join(jobs["build"]["script"]), folder, shell)
    for index in range(1, total + 1):
        script = "\n".join(hidden["before_script"] + jobs["cases"]["script"])
        run(script, folder, shell, CI_NODE_INDEX=str(index), CI_NODE_TOTAL=str(total), CROSSRAY_ARGUMENTS=ARGUMENTS)
    run("\n".join(hidden["before_script"] + jobs["report"]["script"]), folder, shell)
    artifacts = jobs["report"]["artifacts"]
    assert (folder / artifacts["reports"]["junit"]).is_file()
    assert jobs["cases"]["artifacts"]["paths"] == ["parts"] and artifacts["paths"] == ["results"]
    return folder / "results"


def expand(value, names):
    return re.sub(r"\$\{\{ *(.*?) *\}\}", lambda match: names[match.group(1)], str(value))


def run_steps(steps, folder, names):
    """The steps of a job or an action, as far as they are commands; those of others are looked at alone."""
    for step in steps:
        condition = step.get("if", "always()")
        if condition == "inputs.part == ''" and names["inputs.part"] != "":
            continue
        if condition == "inputs.part != ''" and names["inputs.part"] == "":
            continue
        assert condition in ("always()", "inputs.part == ''", "inputs.part != ''"), condition
        if "run" in step:
            variables = {key: expand(value, names) for key, value in step.get("env", {}).items()}
            run(expand(step["run"], names), folder, ["bash", "-eo", "pipefail", "-c"], **variables)
        elif step["uses"] == "./docs/scale/github":
            run_action(folder, {key: expand(value, names) for key, value in step.get("with", {}).items()})
        elif step["uses"].startswith("actions/upload-artifact@"):
            names.setdefault("artifacts", {})[expand(step["with"]["name"], names)] = step["with"]["path"]
        else:
            assert re.match(r"actions/(checkout|download-artifact)@v\d+$", step["uses"]), step["uses"]


def run_action(folder, given):
    (action,) = load("github/action.yml")
    assert set(given) <= set(action["inputs"]), given
    inputs = {f"inputs.{key}": str(given.get(key, value["default"])) for key, value in action["inputs"].items()}
    inputs["inputs.arguments"] = ARGUMENTS
    assert action["runs"]["using"] == "composite"
    assert all(action[key] for key in ("name", "description"))
    assert all(value["description"] and "default" in value for value in action["inputs"].values()), action["inputs"]
    for step in action["runs"]["steps"]:
        assert "run" not in step or step["shell"] == "bash", step  # composite actions need it
    place = folder / "docs/scale/github"  # where GitHub has the action's own files: another checkout, when it is another's
    place.mkdir(parents=True, exist_ok=True)
    os.environ["GITHUB_ACTION_PATH"] = str(place)
    run_steps(action["runs"]["steps"], folder, inputs)
    del os.environ["GITHUB_ACTION_PATH"]
    # What upload and download do: each artifact becomes a folder of its own.
    for name, path in inputs["artifacts"].items():
        (folder / "parts").mkdir(exist_ok=True)
        (folder / path).rename(folder / "parts" / name)


def check_github(folder):
    (workflow,) = load("github/workflow.yml")
    cases, report = workflow["jobs"]["cases"], workflow["jobs"]["report"]
    assert report["needs"] == "cases"
    parts = cases["strategy"]["matrix"]["part"]
    assert parts == list(range(1, len(parts) + 1)), parts
    for part in parts:
        run_steps(cases["steps"], folder, {"matrix.part": str(part), "strategy.job-total": str(len(parts))})
    download = [step["with"] for step in report["steps"] if step.get("uses", "").startswith("actions/download-artifact@")]
    assert download == [{"pattern": "part-*", "path": "parts"}], download
    assert sorted(path.name for path in (folder / "parts").iterdir()) == [f"part-{part}" for part in parts]
    names = {}
    run_steps(report["steps"], folder, names)
    assert names["artifacts"] == {"crossray": "out/ci"}, names
    return folder / "out/ci"


def check_github_action_alone(folder):
    run_action(folder, {})
    assert (folder / "parts/crossray/junit.xml").is_file()
    return folder / "parts/crossray"


def check_kubernetes(folder):
    cases, report = load("kubernetes.yml")
    spec = cases["spec"]
    assert (cases["kind"], spec["completionMode"]) == ("Job", "Indexed")

    def command(job):
        (container,) = job["spec"]["template"]["spec"]["containers"]
        assert container["command"] == ["sh", "-c"] and container["volumeMounts"] == [{"name": "results", "mountPath": "/results"}]
        return container["args"][0].replace("/results", f"{folder}/results")

    for index in range(spec["completions"]):
        run(command(cases), folder, ["sh", "-c"], JOB_COMPLETION_INDEX=str(index), CROSSRAY_ARGUMENTS=ARGUMENTS)
    run(command(report), folder, ["sh", "-c"])
    return folder / "results/run"


def main():
    for script in sorted(FILES.glob("*.sh")):
        subprocess.run(["bash", "-n", script], check=True)
        assert os.access(script, os.X_OK), script
    for name in list(os.environ):  # of an engine that runs this test
        if name.startswith(("CI_NODE_", "SLURM_", "TEST_", "GTEST_", "JOB_COMPLETION")):
            del os.environ[name]
    with tempfile.TemporaryDirectory(prefix="crossray-scale-") as top:
        top = pathlib.Path(top)
        os.environ.setdefault("CROSSRAY_CACHE", str(top / "cache"))
        (top / "whole").mkdir()
        make_workspace(top / "whole")
        run(f"crossray run {ARGUMENTS} --output whole --no-report --progress none", top / "whole", ["sh", "-c"])
        for check in (check_gitlab, check_github, check_github_action_alone, check_kubernetes):
            folder = top / check.__name__
            folder.mkdir()
            make_workspace(folder)
            merged = check(folder)
            assert (merged / "report/index.html").is_file(), merged
            subprocess.run(
                [sys.executable, SOURCE / "tests/scale/same_run.py", top / "whole/whole/run.json", merged / "run.json"], check=True)
            print(f"ok: {check.__name__}")


main()
