"""The figures and tables of the paper, made again: what contactctl paper does."""

from .items import Item, Number
from .make import ITEMS, make_items, write_paper

__all__ = ["ITEMS", "Item", "Number", "make_items", "write_paper"]
