"""Where the air channel may end; known without the CAD kernel."""

from __future__ import annotations

CHANNEL_ENDS = (0.5, 0.25, 0.4, 0.75, 0.1)
"""Where the channel may end, in its fillets past the middle of the last chamber: the first is used
unless the CAD kernel fails there."""
