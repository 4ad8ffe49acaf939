"""A virtual leak test: where air could pass between the beads of a sliced part, and how widely.

`leak_test` is the way in; `result` holds the records it hands back.
"""
