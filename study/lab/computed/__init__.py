"""How carom computes what others measured: a file for each subject."""
