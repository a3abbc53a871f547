"""The fixed set of calls whose outputs `same_bytes.py` compares, and the small inputs they read.

`byte_inputs.py` draws them.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Call:
    """A call of a verb. name: of the folder of its result. words: the command line but for `-o`.

    `{inputs}` and `{out}` in it are the folders of the inputs and of all results.
    """

    name: str
    words: tuple[str, ...]


QUICK = ("--lens", "pinhole", "--cameras", "shared", "--principal-point", "middle",
    "--max-features", "1500")  # fmt: skip
CALLS = (
    Call("facade-one", ("facade", "{inputs}/house0.png", "--height-m", "15")),
    Call(
        "facade-three",
        ("facade", *(f"{{inputs}}/house{row}.png" for row in range(3)), "--rectified"),
    ),
    Call("facade-plain", ("facade", "{inputs}/house1.png", "--eyes", "plain")),
    Call("facade-document", ("facade", "{out}/facade-one/house0/facade.json", "--depth-m", "7")),
    Call("grammar-three", ("grammar", "derive", "haussmann", "--lots", "{inputs}/three.geojson")),
    Call("grammar-demo", ("grammar", "derive", "victorian", "--seed", "4")),
    Call(
        "grammar-tiled",
        ("grammar", "derive", "haussmann", "--lots", "{inputs}/many.geojson", "--seed", "2"),
    ),
    Call("plan-document", ("plan", "{inputs}/plan.json")),
    Call("plan-north", ("plan", "{inputs}/plan.json", "--north", "30", "--no-furniture")),
    Call(
        "plan-panorama",
        ("plan", "{inputs}/plan.json", "--panorama", "{inputs}/around.png", "--seed", "1"),
    ),
    Call("plan-dxf", ("plan", "{inputs}/rooms.dxf", "--surroundings", "none")),
    Call("plan-picture", ("plan", "{inputs}/plan.png")),
    Call("photos-corner", ("photos", "{inputs}/corner", *QUICK)),
    Call(
        "photos-textured",
        (
            "photos", "{inputs}/corner", *QUICK, "--model", "{inputs}/lots.geojson",
            "--crs", "EPSG:25832", "--gcp", "{inputs}/gcp.txt",
        ),
    ),
    Call("carve-ball", ("carve", "{inputs}/ball", "--levels", "6")),
    Call("dense-wall", ("dense", "{inputs}/wall")),
    Call("drive-street", ("drive", "{inputs}/street")),
    Call("walk-gorge", ("walk", "{inputs}/gorge")),
    Call("fauna-eel", ("fauna", "{inputs}/eel.csv", "--kind", "fish")),
    Call("fauna-film", ("fauna", "{inputs}/worm")),
)  # fmt: skip


def command(call: Call, inputs: str, out: str) -> list[str]:
    """The words of the command line, after `veduta`."""
    words = [word.format(inputs=inputs, out=out) for word in call.words]
    return [*words, "-o", f"{out}/{call.name}", "--quiet"]
