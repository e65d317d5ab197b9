"""The benchmarks: one module a subcommand, what they share, and the page."""
