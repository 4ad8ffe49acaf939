"""What a shell completes: names and files, found without any of the heavy libraries."""
