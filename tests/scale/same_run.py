"""Whether two run.json say the same: everything but times, memory, places of work and who ran it."""
import json
import sys

HEAD = ("started", "seconds", "firstVerdictMs", "commandLine", "toolPeakBytes", "workersPeakBytes", "cores", "parts")


def strip(path):
    with open(path, encoding="utf-8") as file:
        run = json.load(file)
    for key in HEAD:
        del run[key]
    for record in run["backends"].values():
        del record["startMs"]
    for case in run["cases"]:
        del case["times"], case["answeredBy"]
        for result in case["backends"]:
            del result["times"], result["programsWereWarm"]
    return run


def main():
    first, second = strip(sys.argv[1]), strip(sys.argv[2])
    for key in first.keys() | second.keys():
        if key != "cases" and first.get(key) != second.get(key):
            print(f"{key}: {first.get(key)} against {second.get(key)}")
    names = [[case["name"] for case in run["cases"]] for run in (first, second)]
    if names[0] != names[1]:
        print("only in one:", sorted(set(names[0]) ^ set(names[1])))
    for a, b in zip(first["cases"], second["cases"]):
        if a != b:
            print("differs:", a["name"])
    print(f"{len(first['cases'])} cases, {sum(len(case['backends']) for case in first['cases'])} verdicts")
    return 0 if first == second and first["cases"] else 1


sys.exit(main())
