"""From rectified pairs to local models, their morphs, and the place that one walks through."""
