"""The project's own objects: each is built by code for any size within its range."""
