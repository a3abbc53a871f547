"""The JSON schema of what the studio reads; its TypeScript types are generated from this.

`python -m veduta.studio.schema` prints it; `npm run generate` in `studio/` writes the types.
"""

from __future__ import annotations

import json
import sys

from pydantic import BaseModel, ConfigDict

from veduta.place.manifest import Place
from veduta.place.semantics import Provenance, SemanticClass


class StudioContract(BaseModel):
    """Everything that the Python side hands to the browser, by name."""

    model_config = ConfigDict(extra="forbid", json_schema_serialization_defaults_required=True)

    place: Place
    semantic_class: SemanticClass
    provenance: Provenance


def studio_schema() -> str:
    """The schema as JSON text."""
    schema = StudioContract.model_json_schema(by_alias=True, mode="serialization")
    return json.dumps(schema, indent=1) + "\n"


if __name__ == "__main__":
    sys.stdout.write(studio_schema())
