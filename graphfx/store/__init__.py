"""Processor sets, the data-parallel primitives over their columns, and the threads that carry them out."""

from graphfx.store.primitives import exclusive_scan, gather, offsets, partition, segmented_scan
from graphfx.store.processors import BLOCK, Column, ProcessorSet
from graphfx.store.sorting import stable_argsort, stable_argsort_words
from graphfx.store.threads import available_threads, parallel, parallel_ranges, ranges

__all__ = [
    "BLOCK", "Column", "ProcessorSet", "available_threads", "exclusive_scan", "gather", "offsets", "parallel",
    "parallel_ranges", "partition", "ranges", "segmented_scan", "stable_argsort", "stable_argsort_words",
]
