"""The values that everything passes around: scene, parts, labels, vocabulary, graph, truth; and their files."""
