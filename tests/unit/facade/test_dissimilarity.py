"""Unlike rows or columns, against sums over each pair."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.dissimilarity import at_offsets, of_pairs


@given(st.integers(1, 12), st.integers(1, 9), st.integers(0, 1000))
def test_pairs_are_as_far_apart_as_their_differences(count: int, size: int, seed: int) -> None:
    vectors = np.random.default_rng(seed).normal(size=(count, size))
    squares = [[sum((a - b) ** 2) for b in vectors] for a in vectors]
    np.testing.assert_allclose(of_pairs(vectors), squares, atol=1e-9)


@given(st.integers(1, 12), st.integers(0, 1000), st.data())
def test_an_offset_is_the_mean_of_its_pairs(count: int, seed: int, data: st.DataObject) -> None:
    distance = np.random.default_rng(seed).normal(size=(count, count))
    reach = data.draw(st.integers(1, count))
    unlike = at_offsets(distance, reach)
    assert unlike.shape == (reach,)
    for offset, found in enumerate(unlike):
        pairs = [distance[i, i + offset] for i in range(count - offset)]
        assert found == pytest.approx(sum(pairs) / len(pairs))
