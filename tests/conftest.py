import os

from hypothesis import settings

# The same examples on every machine, so that a run says something about the change and not about luck;
# HYPOTHESIS_PROFILE=explore looks for new ones.
settings.register_profile("fixed", derandomize=True, database=None)
settings.register_profile("explore", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


def pytest_addoption(parser):
    parser.addoption("--renew-golden", action="store_true", help="write the records in tests/golden anew")
