// Nothing: a target has headers precompiled only if it has a file.
