"""Checks project files against the JSON schema with two independent readers.

Arguments: the schema, a folder with the subfolders `valid` and `invalid`.
`jsonschema` judges the values, `tombi` (the language server that editors run) the files.
Both must accept every file of `valid` and flag every file of `invalid`.
"""

import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema

schema_path = pathlib.Path(sys.argv[1]).resolve()
folder = pathlib.Path(sys.argv[2])
schema = json.loads(schema_path.read_text(encoding="utf-8"))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
tombi = pathlib.Path(sys.executable).with_name("tombi")
faults = []


def lint(path):
    """What tombi says about a file, with the schema named in its first line."""
    lines = path.read_text(encoding="utf-8").removeprefix("\ufeff").splitlines()
    lines = [line for line in lines if not line.startswith("#:schema")]
    copy = path.with_name("linted.toml")
    text = "\n".join([f"#:schema {schema_path.as_uri()}", *lines]) + "\n"
    copy.write_text(text, encoding="utf-8")
    done = subprocess.run(
        [tombi, "lint", "--offline", "--quiet", copy], capture_output=True, text=True
    )
    copy.unlink()
    return done.returncode == 0, done.stdout + done.stderr


counts = {}
for kind in ["valid", "invalid"]:
    files = sorted((folder / kind).glob("*.toml"))
    counts[kind] = len(files)
    for path in files:
        value = tomllib.loads(path.read_text(encoding="utf-8"))
        errors = [error.message for error in validator.iter_errors(value)]
        clean, said = lint(path)
        if (not errors) != (kind == "valid"):
            faults.append(f"jsonschema on {kind} {path.name}: {errors}")
        if clean != (kind == "valid"):
            faults.append(f"tombi on {kind} {path.name}: {said}")

if faults:
    sys.exit("\n".join(faults))
print(f"{counts['valid']} valid, {counts['invalid']} invalid")
