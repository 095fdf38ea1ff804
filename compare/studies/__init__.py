"""One module a study: which courses are marched, what is scored, what is kept to be drawn."""
