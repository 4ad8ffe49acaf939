"""Checked parameters, and one clear sentence for each problem of theirs."""
