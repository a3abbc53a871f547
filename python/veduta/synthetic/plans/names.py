"""Words for rooms, as plans print them: in full and short, in five languages."""

from __future__ import annotations

from collections.abc import Mapping

from veduta.synthetic.plans.house import Language, Use

FULL: Mapping[Language, Mapping[Use, tuple[str, ...]]] = {
    "en": {
        "living": ("Living Room", "Lounge", "Reception Room", "Sitting Room"),
        "dining": ("Dining Room",), "kitchen": ("Kitchen",),
        "bedroom": ("Bedroom", "Bedroom {n}", "Bed {n}"), "bathroom": ("Bathroom", "Bath"),
        "toilet": ("WC", "Toilet"), "utility": ("Utility", "Laundry"),
        "storage": ("Store", "Storage"), "wardrobe": ("Closet", "Wardrobe"),
        "hall": ("Hall", "Entrance Hall"), "corridor": ("Landing", "Corridor"),
        "stairs": ("Stairs",), "study": ("Study", "Office"), "sauna": ("Sauna",),
        "garage": ("Garage",),
    },
    "pt": {
        "living": ("Sala", "Sala de estar"), "dining": ("Sala de jantar",), "kitchen": ("Cozinha",),
        "bedroom": ("Quarto", "Quarto {n}"), "bathroom": ("Casa de banho", "Banho"),
        "toilet": ("WC",), "utility": ("Lavandaria",), "storage": ("Arrumos", "Despensa"),
        "wardrobe": ("Roupeiro",), "hall": ("Hall", "Entrada"), "corridor": ("Corredor",),
        "stairs": ("Escadas",), "study": ("Escritório",), "sauna": ("Sauna",),
        "garage": ("Garagem",),
    },
    "fr": {
        "living": ("Séjour", "Salon"), "dining": ("Salle à manger",), "kitchen": ("Cuisine",),
        "bedroom": ("Chambre", "Chambre {n}"), "bathroom": ("Salle de bains", "Salle d'eau"),
        "toilet": ("WC",), "utility": ("Buanderie",), "storage": ("Rangement", "Cellier"),
        "wardrobe": ("Dressing",), "hall": ("Entrée",),
        "corridor": ("Dégagement", "Couloir"), "stairs": ("Escalier",), "study": ("Bureau",),
        "sauna": ("Sauna",), "garage": ("Garage",),
    },
    "de": {
        "living": ("Wohnzimmer", "Wohnen"), "dining": ("Esszimmer", "Essen"),
        "kitchen": ("Küche",), "bedroom": ("Schlafzimmer", "Schlafen", "Kind {n}"),
        "bathroom": ("Bad", "Badezimmer"), "toilet": ("WC", "Gäste-WC"),
        "utility": ("HWR", "Hauswirtschaft"), "storage": ("Abstellraum",),
        "wardrobe": ("Ankleide",), "hall": ("Diele", "Eingang"), "corridor": ("Flur",),
        "stairs": ("Treppe",), "study": ("Arbeitszimmer", "Büro"), "sauna": ("Sauna",),
        "garage": ("Garage",),
    },
    "fi": {
        "living": ("OH", "Olohuone"), "dining": ("RUOK", "Ruokailu"), "kitchen": ("K", "Keittiö"),
        "bedroom": ("MH", "MH {n}", "Makuuhuone"), "bathroom": ("KPH", "PH", "PSH"),
        "toilet": ("WC",), "utility": ("KHH",), "storage": ("VAR", "Varasto"), "wardrobe": ("VH",),
        "hall": ("ET", "Eteinen"), "corridor": ("KÄYT", "Käytävä"), "stairs": ("Portaat",),
        "study": ("Työhuone",), "sauna": ("S", "Sauna"), "garage": ("AT", "Autotalli"),
    },
}  # fmt: skip

SHORT: Mapping[Language, Mapping[Use, str]] = {
    "en": {
        "bathroom": "Bath", "storage": "St.", "wardrobe": "W", "utility": "Util.", "hall": "Hall",
        "toilet": "WC", "study": "Study",
    },
    "pt": {
        "bathroom": "Banho", "storage": "Arr.", "wardrobe": "Roup.", "toilet": "WC",
        "hall": "Hall", "utility": "Lav.",
    },
    "fr": {
        "bathroom": "SDB", "storage": "Rgt", "wardrobe": "Dress.", "toilet": "WC",
        "corridor": "Dgt", "utility": "Buand.",
    },
    "de": {
        "bathroom": "Bad", "storage": "Abst.", "utility": "HWR", "toilet": "WC", "hall": "Diele",
        "corridor": "Flur", "study": "Arb.",
    },
    "fi": {
        "living": "OH", "dining": "RUOK", "kitchen": "K", "bedroom": "MH", "bathroom": "PH",
        "utility": "KHH", "storage": "VAR", "wardrobe": "VH", "hall": "ET", "corridor": "KÄYT",
        "sauna": "S", "garage": "AT", "toilet": "WC", "study": "TH",
    },
}  # fmt: skip
STOREYS: Mapping[Language, tuple[str, ...]] = {
    "en": ("Ground Floor", "First Floor", "Second Floor"),
    "pt": ("Rés-do-chão", "Piso 1", "Piso 2"),
    "fr": ("Rez-de-chaussée", "1er étage", "2e étage"),
    "de": ("Erdgeschoss", "Obergeschoss", "Dachgeschoss"),
    "fi": ("1. kerros", "2. kerros", "3. kerros"),
}
UP: Mapping[Language, str] = {"en": "UP", "pt": "SOBE", "fr": "H", "de": "auf", "fi": "ylös"}
