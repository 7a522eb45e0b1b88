"""Devices and structures of primitives, as plant-design systems draw them."""
