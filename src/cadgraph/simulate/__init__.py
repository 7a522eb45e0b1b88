"""A plant whose valves turn and whose gauges answer: what simulators need of it."""
