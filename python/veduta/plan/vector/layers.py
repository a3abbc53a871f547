"""What a layer or a block holds, by the words of its name in the languages of plans."""

from __future__ import annotations

import re
from typing import Literal

Role = Literal[
    "wall", "door", "window", "opening", "stairs", "other", "thing", "annotation"
]  # fmt: skip
"""`thing`: furniture and fixtures; `annotation`: words, sizes, grids, and what is not of the floor
(foundations, roofs, cables); `other`: the name does not tell."""

# The first list that has a word of the name decides: `A-DOOR-IDEN` is writing, `S-STEM-WALL` a
# foundation.
OPENINGS: tuple[Role, ...] = ("door", "window", "opening")
_WORDS: tuple[tuple[Role, tuple[str, ...]], ...] = (
    (
        "annotation",
        (
            "dim", "dims", "text", "txt", "anno", "annotation", "note", "notes", "iden", "symb",
            "titl", "title", "border", "legend", "grid", "axis", "axes", "defpoints", "viewport",
            "vport", "patt", "pattern", "hatch", "leader", "area", "areas", "space", "zone",
            "bemassung", "bemaßung", "masse", "maße", "achse", "achsen", "schrift", "schraffur",
            "cote", "cotes", "cotation", "texte", "hachure", "hachures", "cotas", "texto", "eixo",
            "eixos", "mitta", "mitat", "teksti", "rasteri", "viewports", "sheet", "ttlb",
            "stem", "footer", "footing", "foundation", "fnd", "fndn", "found", "fundament", "slab",
            "roof", "truss", "joist", "joists", "beam", "beams", "rafter", "overhang", "dach",
            "toit", "toiture", "telhado", "katto", "ceiling", "clng", "elec", "electrical", "light",
            "lighting", "lite", "power", "hvac", "mech", "duct", "site", "survey", "contour",
            "landscape", "plant", "topo", "property", "section", "elevation", "detail", "temp",
            "xref", "hidden",
        ),
    ),
    (
        "stairs",
        (
            "stair", "stairs", "strs", "treppe", "treppen", "escalier", "escaliers", "escada",
            "escadas", "escalera", "portaat", "porras", "trappa", "steps",
        ),
    ),
    (
        "door",
        (
            "door", "doors", "sgd", "tür", "tuer", "türen", "tueren", "tor", "porte", "portes",
            "porta", "portas", "puerta", "puertas", "ovi", "ovet", "dörr", "dörrar",
        ),
    ),
    (
        "window",
        (
            "window", "windows", "glaz", "glazing", "fenster", "fenetre", "fenêtre", "fenetres",
            "fenêtres", "janela", "janelas", "ventana", "ventanas", "ikkuna", "ikkunat", "fönster",
        ),
    ),
    (
        "opening",
        (
            "opening", "openings", "header", "headers", "glass", "öffnung", "öffnungen",
            "oeffnung", "oeffnungen", "menuiserie", "menuiseries", "ouverture", "ouvertures",
            "baie", "baies", "esquadria", "esquadrias", "aukot",
        ),
    ),
    (
        "thing",
        (
            "furn", "furniture", "fixt", "fixture", "fixtures", "case", "casework", "cabinet",
            "cabinets", "flor", "sanit", "sanitary", "plumb", "plumbing", "pfix", "equip", "eqpm",
            "appl", "appliance", "appliances", "toilet", "sink", "bath", "möbel", "moebel",
            "einrichtung", "sanitär", "sanitaer", "küche", "meuble", "meubles", "mobilier",
            "sanitaire", "sanitaires", "mobilia", "mobiliario", "mobiliário", "louca", "louça",
            "loucas", "louças", "mueble", "muebles", "kaluste", "kalusteet", "people", "car",
            "tree", "trees", "entourage",
        ),
    ),
    (
        "wall",
        (
            "wall", "walls", "partition", "partitions", "column", "columns", "cols", "wand",
            "wände", "waende", "wande", "mauer", "mauern", "mauerwerk", "stütze", "stuetze", "mur",
            "murs", "cloison", "cloisons", "poteau", "poteaux", "parede", "paredes", "alvenaria",
            "pilar", "pilares", "muro", "muros", "pared", "tabique", "seinä", "seinät", "seina",
            "sein", "seinat", "pilari", "vägg", "väggar", "vagg",
        ),
    ),
)  # fmt: skip
_BOUND = re.compile(r"[^\W\d_]+")


def role_of(name: str) -> Role:
    """The role of a layer or block; of one that was bound from another file, by its own name."""
    own = re.split(r"\$\d+\$|\|", name)[-1]
    words = {word.lower() for word in _BOUND.findall(own)}
    for role, known in _WORDS:
        if words & set(known):
            return role
    # One word for all of it, as `Aussenwände` or `Innertür`; short ones would be anywhere.
    for role, known in reversed(_WORDS):
        if any(word.endswith(tail) for word in words for tail in known if len(tail) >= 4):
            return role
    return "other"
