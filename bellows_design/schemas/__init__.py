"""JSON Schemas (draft 2020-12) of what commands answer with ``--json``, and of an export's records.

One file for each command in a folder for each version; ``docs/json.md`` says what makes a version.
"""
