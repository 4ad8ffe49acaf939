"""What a solution says: stress, strain, reactions, files for ParaView."""
