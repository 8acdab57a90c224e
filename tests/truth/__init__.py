"""Truth: casts held to first roots that Arb ball arithmetic certifies. `python -m tests.truth` runs it at length."""
