"""Shards of a run that is as large as you like, made from a real one: its cases over and over under new names, one in FAILING with a
failure on its first backend. Of planes there are none. For measuring crossray merge, report and diff.

    many_cases.py RUN OUT CASES [SHARDS [FAILING]]       RUN: a run's folder; OUT/shard-I-of-N.made/run.json
"""
import json
import pathlib
import sys

kPrime = 0x0000000001000000000000000000013B
kOffset = 0x6C62272E07BB014262B821756295C58D
kMask = (1 << 128) - 1


def hash_names(names):
    """hashNames of harness/run/run_plan.cpp: FNV-1a in 128 bits over lengths and bytes."""
    state = kOffset
    for name in sorted(name.encode() for name in names):
        for byte in len(name).to_bytes(8, "little") + name:
            state = (state ^ byte) * kPrime & kMask
    return f"{state:032x}"


def make_failed(case):
    """The same case, as if the first expectation of the first backend that has one had failed."""
    for result in case["backends"]:
        for expectation in result["expectations"]:
            if not expectation["judged"]:
                continue
            comparison = expectation["comparison"]
            result.update(verdict="fail", reason=f"{expectation['output']}: 1 pixel is beyond its tolerance")
            comparison.update(passed=False, failed=1, reason="1 pixel is beyond its tolerance")
            comparison["census"] = {"beyond tolerance": 1}
            return case
    return case


def main():
    source, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    count = int(sys.argv[3])
    shards = int(sys.argv[4]) if len(sys.argv) > 4 else 20
    failing = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    run = json.loads((source / "run.json").read_text(encoding="utf-8"))
    texts = []
    for case in run.pop("cases"):
        case.update(name="@NAME@", expected="")
        case.pop("conditioning", None)
        for result in case["backends"]:
            result.update(planes="", trace="")
        texts.append([json.dumps(each, separators=(",", ":"), ensure_ascii=False)
                      for each in (case, make_failed(json.loads(json.dumps(case))))])
    names = sorted(f"many/copy_{i // len(texts):04}/case_{i % len(texts):04}" for i in range(count))
    run["plan"].update(cases=count, names=hash_names(names), partition=f"{shards} parts by name")
    for shard in range(1, shards + 1):
        own = names[shard - 1::shards]
        run["shard"], run["attempt"] = f"{shard}/{shards}", "made"
        run["plan"]["ownCases"] = len(own)
        folder = out / f"shard-{shard}-of-{shards}.made"
        folder.mkdir(parents=True)
        with open(folder / "run.json", "w", encoding="utf-8") as file:
            file.write(json.dumps(run, indent=1)[:-2] + ',\n "cases": [')
            for i, name in enumerate(own):
                fails = failing > 0 and ((shard - 1) + i * shards) % failing == 0
                text = texts[((shard - 1) + i * shards) % len(texts)][fails]
                file.write(("," if i else "") + "\n  " + text.replace("@NAME@", name, 1))
            file.write("\n ]\n}\n")


main()
