"""What presets are built of: flanges, bolts, pipe, valves, gauges, pumps, vessels, steel."""
