"""From a record to views: cameras, photos, silhouettes."""
