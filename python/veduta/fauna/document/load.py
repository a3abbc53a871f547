"""Reading and writing `animal.json`."""

from __future__ import annotations

import json
from pathlib import Path

from pydantic import ValidationError

from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.schema import Animal
from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.inputs import require_file

DOCUMENT = "animal.json"
_MOST_BYTES = 200_000_000


def load_animal(path: Path) -> Animal | LimbedAnimal:
    """The document in a file; InputError where it is none."""
    remedy = "Give an animal.json that `veduta fauna` has written."
    try:
        require_file(path, _MOST_BYTES)
        content = path.read_bytes()
        if b'"veduta/limbed-animal"' in content[:2000]:
            return LimbedAnimal.model_validate_json(content)
        return Animal.model_validate_json(content)
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", remedy) from error
    except ValidationError as error:
        raise InputError(path, f"is no animal document: {first_fault(error)}", remedy) from error


def save_animal(animal: Animal | LimbedAnimal, path: Path) -> None:
    """Write it, indented so that a person can edit it; states stand a line each."""
    told = animal.model_dump(mode="json", by_alias=True)
    if isinstance(animal, LimbedAnimal):
        poses = {name: told["poses"].pop(name) for name in ("turns", "root", "down")}
        long = ",\n  ".join(f'"{name}": {json.dumps(value)}' for name, value in poses.items())
        text = json.dumps(told, indent=1, ensure_ascii=False)
        head, mark, rest = text.partition('"poses": {\n')
        write_bytes(path, f"{head}{mark}  {long},\n{rest}\n".encode())
        return
    states = told["motion"].pop("states")
    text = json.dumps(told, indent=1, ensure_ascii=False)
    rows = ",\n   ".join(
        json.dumps([[round(re, 9), round(im, 9)] for re, im in state]) for state in states
    )
    head, mark, rest = text.partition('"motion": {\n')
    write_bytes(path, f'{head}{mark}  "states": [\n   {rows}\n  ],\n{rest}\n'.encode())
