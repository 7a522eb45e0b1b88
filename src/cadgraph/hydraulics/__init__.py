"""What flows and which pressure stands where: a scenario, a network of pipes, a solver, and a process in time."""
