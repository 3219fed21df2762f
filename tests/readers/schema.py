"""Holds a JSON document to a schema with an independent reader. Arguments: the schema, the document."""

import json
import pathlib
import sys

import jsonschema

schema, document = (json.loads(pathlib.Path(p).read_text(encoding="utf-8")) for p in sys.argv[1:3])
jsonschema.Draft7Validator.check_schema(schema)
faults = [e.message for e in jsonschema.Draft7Validator(schema).iter_errors(document)]
assert not faults, faults
# A document without a required field is refused: the schema says something.
for name in schema["required"]:
    less = {key: value for key, value in document.items() if key != name}
    assert not jsonschema.Draft7Validator(schema).is_valid(less), name
print("ok", len(document["patches"]), "patches")
