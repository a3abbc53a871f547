"""Animals filmed by code, with all of it known: shape, joints, feet and cycle."""

from veduta.synthetic.animals.film import Filmed
from veduta.synthetic.animals.legged import film_lizard, film_quadruped
from veduta.synthetic.animals.limbless import film_limbless
from veduta.synthetic.animals.sideways import film_fish_from_side
from veduta.synthetic.animals.turning import turned_round

__all__ = [
    "Filmed",
    "film_fish_from_side",
    "film_limbless",
    "film_lizard",
    "film_quadruped",
    "turned_round",
]
