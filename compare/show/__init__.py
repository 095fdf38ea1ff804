"""Records as tables, texts and figures."""
