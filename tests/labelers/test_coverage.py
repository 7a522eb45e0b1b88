from cadgraph.labelers.coverage import find_unlearnt
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary

VOCABULARY = default_vocabulary()


def test_names_that_the_model_has_not_learnt_are_told():
    mine = Vocabulary({"Pipe assembly": Group(("pipe", "warp coil")), "Tank": Group(("tank",))})
    (told,) = find_unlearnt(EmbeddedLabeler().learnt, mine)
    assert told.code == "vocabulary-unknown-to-model"
    assert "Pipe assembly/warp coil" in told.message
    assert "Pipe assembly/pipe" not in told.message


def test_nothing_is_told_of_the_built_in_vocabulary():
    assert find_unlearnt(EmbeddedLabeler().learnt, VOCABULARY) == ()
