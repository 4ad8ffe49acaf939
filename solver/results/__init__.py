"""Evaluation of a solution: stress, strain, reactions, files for ParaView."""
