"""Who says what a part is: the embedded network, a vision-language model, catalogues, corrections."""
