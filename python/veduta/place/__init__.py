"""Place, Part, Material, surface semantics: what every verb makes and every format writes."""
