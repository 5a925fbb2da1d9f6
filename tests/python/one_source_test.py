"""The synchronous client is the asynchronous one, not awaited: client.py is made from aio.py."""

import importlib.util
import inspect
import pathlib
import unittest

from contactsim import AsyncClient, Client

PACKAGE = pathlib.Path(__file__).parents[2] / "client" / "python"


def maker():
    spec = importlib.util.spec_from_file_location("make_client", PACKAGE / "make_client.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class OneSourceTest(unittest.TestCase):

    def test_client_is_what_its_source_makes(self):
        made = maker().sync_text((PACKAGE / "contactsim" / "aio.py").read_text("utf-8"))
        kept = (PACKAGE / "contactsim" / "client.py").read_text("utf-8")
        self.assertEqual(made, kept, "run python3 client/python/make_client.py")

    def test_both_have_the_same_calls_with_the_same_arguments(self):
        def calls(client):
            return {name: list(inspect.signature(call).parameters)
                    for name, call in vars(client).items()
                    if callable(call) and not name.startswith("_")}
        self.assertEqual(calls(Client), calls(AsyncClient))
        self.assertIn("sweep", calls(Client))

    def test_they_tell_their_server(self):
        with Client("there:7") as client:
            self.assertEqual(repr(client), "<Client there:7>")

    def test_nothing_is_awaited_in_the_synchronous_one(self):
        text = inspect.getsource(Client)
        for word in ("async", "await"):
            self.assertNotIn(word, text)


if __name__ == "__main__":
    unittest.main()
