"""The catalogue of objects: SQL texts, read into a database in memory, and a user's own file.

It is kept as text so that changes of it can be read; `python -m veduta.plan.furnish.catalogue.copy
FILE.sqlite` writes it as a database to start one's own from.
"""
