"""Numbers from any code in any language, judged against the proven truth."""
