"""What `--max-memory` leaves for each step."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MemoryParameters:
    """pictures, cloud, volume: shares of the memory. The cloud stays while the volume is filled,
    but at the height of its own step it takes three times what stays.
    point_bytes, block_bytes: what a point of the cloud, and a block of 8 x 8 x 8 voxels (4 kB) with
    its share of the surface, take at the height of their steps: estimates by the sizes of their
    arrays, which `benchmarks/dense/growth.py` holds against the kernel's figures.
    """

    pictures: float = 0.1
    cloud: float = 0.4
    volume: float = 0.6
    point_bytes: float = 130.0
    block_bytes: float = 8_000.0

    def picture_bytes(self, memory_gb: float) -> float:
        """Of photos that stay in memory between steps."""
        return self.pictures * memory_gb * 1e9

    def most_points(self, memory_gb: float) -> int:
        """That the cloud may have."""
        return int(self.cloud * memory_gb * 1e9 / self.point_bytes)

    def most_blocks(self, memory_gb: float) -> int:
        """That the volume may have."""
        return max(1000, int(self.volume * memory_gb * 1e9 / self.block_bytes))
