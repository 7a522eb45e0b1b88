"""What families are made of: parameters that are drawn or given, and a drafting table on which parts are put."""
