"""A virtual leak test: where air could pass between the beads of a sliced part, and how widely.

`leak_test` is the way in; `result` holds the records it hands back, `picture` draws the layer of
the leak. The method is described in `docs/leak-test.md`.
"""

from printers.leak_test.result import LeakTest
from printers.leak_test.run import leak_test

__all__ = ["LeakTest", "leak_test"]
