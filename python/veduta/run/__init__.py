"""What every verb runs on: errors, options, digests, cache, pool, progress, report."""
