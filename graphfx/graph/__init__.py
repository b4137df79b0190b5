"""The JSON graph language: reading, checking, flattening, formatting, and its schema.

    document  ->  check  ->  flatten
"""
