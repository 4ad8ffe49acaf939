"""The charts of a report as plain values, whatever draws them."""
