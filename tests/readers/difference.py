"""Holds a difference to its schema with an independent reader, and its numbers to each other.

Arguments: the schema, the difference.
"""

import collections
import json
import pathlib
import sys

import jsonschema

schema, difference = (json.loads(pathlib.Path(p).read_text(encoding="utf-8")) for p in sys.argv[1:3])
jsonschema.Draft7Validator.check_schema(schema)
faults = [e.message for e in jsonschema.Draft7Validator(schema).iter_errors(difference)]
assert not faults, faults

plural = {"lamella": "lamellae", "bill-row": "bill rows", "patch": "patches"}
found = collections.Counter()
for change in difference["changes"]:
    found[plural.get(change["kind"], change["kind"] + "s"), change["action"], change["class"]] += 1
for count in difference["summary"]["counts"]:
    what = count["what"]
    both = sum(count[name] for name in ["recut", "reassemble", "redraw", "noise", "same"])
    assert count["before"] == both + count["removed"], count
    assert count["after"] == both + count["added"], count
    if what == "openings":
        continue
    for action in ["added", "removed"]:
        told = sum(n for (kind, name, _), n in found.items() if (kind, name) == (what, action))
        assert told == count[action], (count, told)
    assert found[what, "changed", "recut"] == count["recut"], count
worst = [{"recut": 0, "reassemble": 1, "redraw": 2}[c["class"]] for c in difference["changes"]]
assert worst == sorted(worst), "the worst stands first"
for change in difference["changes"]:
    for field in change["fields"]:
        before, after, delta = field["before"], field["after"], field["delta"]
        if all(isinstance(value, (int, float)) for value in [before, after, delta]):
            # Three numbers, each rounded: shares to hundredths, others to thousandths or finer.
            step = 1e-2 if field["quantity"] == "share" else 1e-3
            assert abs(after - before - delta) <= 1.6 * step, field
print("ok", len(difference["changes"]), "changes")
