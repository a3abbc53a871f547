"""The thresholds of all steps, and what takes the place of an option that is not given."""

from __future__ import annotations

from dataclasses import dataclass, field

from veduta.dense.build.cloud import CloudParameters
from veduta.dense.build.elevation import ElevationParameters
from veduta.dense.build.model_distance import DistanceParameters
from veduta.dense.build.single_view import SingleViewParameters
from veduta.dense.build.surface import SurfaceParameters
from veduta.dense.memory import MemoryParameters
from veduta.dense.read.agreeing import AgreeParameters
from veduta.dense.read.linking import LinkParameters
from veduta.dense.read.matching import MatchParameters
from veduta.dense.read.neighbours import NeighbourParameters
from veduta.dense.read.sparse import SparseParameters


@dataclass(frozen=True)
class DenseParameters:
    """One of each step."""

    memory: MemoryParameters = field(default_factory=MemoryParameters)
    sparse: SparseParameters = field(default_factory=SparseParameters)
    neighbours: NeighbourParameters = field(default_factory=NeighbourParameters)
    match: MatchParameters = field(default_factory=MatchParameters)
    link: LinkParameters = field(default_factory=LinkParameters)
    agree: AgreeParameters = field(default_factory=AgreeParameters)
    cloud: CloudParameters = field(default_factory=CloudParameters)
    elevation: ElevationParameters = field(default_factory=ElevationParameters)
    distance: DistanceParameters = field(default_factory=DistanceParameters)
    single: SingleViewParameters = field(default_factory=SingleViewParameters)
    surface: SurfaceParameters = field(default_factory=SurfaceParameters)
