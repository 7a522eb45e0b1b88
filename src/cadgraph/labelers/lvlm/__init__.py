"""Labels by a vision-language model: on OpenAI's or any compatible server, in a batch, or by hand from a folder.

``kind`` finds what needs only one question, ``gallery`` draws it, ``prompt`` words it, ``answer`` checks what comes
back, ``asking`` sees a run through (cache, budget, again), ``labeler`` makes labels of it. ``client``, ``batch`` and
``folder`` are three ways to be answered; ``growth`` lets the model grow the vocabulary. Answers and everything from
the scene are data: limited, checked against a schema, and never taken as instructions.
"""
