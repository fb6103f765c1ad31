"""A domain and an instance, and sessions in which they are open."""

import tempfile
import unittest
from pathlib import Path

from client import Client

DOMAIN = """// Fires spread over a grid.
domain fire {
    types { place : object; wind : {@calm, @storm}; };
    pvariables {
        // How fast a fire spreads.
        RATE(place, place) : { non-fluent, real, default = 0.1 };
        burning(place) : { state-fluent, bool, default = false };  // on fire now
        weather : { state-fluent, wind, default = @calm };
        douse(place) : { action-fluent, bool, default = false };
    };
    cpfs {
        burning'(?p) = if (douse(?p)) then false
                       else burning(?p) | exists_{?q : place} [burning(?q) ^ Bernoulli(RATE(?p, ?q))];
        weather' = if (weather == @storm) then @calm else @storm;
    };
    reward = -sum_{?p : place} burning(?p);
}
"""
INSTANCE = """non-fluents grid {
    domain = fire;
    objects { place : {north, south, east}; };
    non-fluents { RATE(north, south) = 0.5; };
}
instance small {
    domain = fire;
    non-fluents = grid;
    init-state { burning(north); };
    horizon = 10;
    discount = 1.0;
}
"""


class Test(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()

    def client(self, *arguments, **options):
        client = Client(self.folder, *arguments, **options)
        self.addCleanup(client.__exit__)
        return client

    def opened(self, *arguments, domain=DOMAIN, instance=INSTANCE):
        client = self.client(*arguments)
        client.open("domain.rddl", domain)
        client.open("instance.rddl", instance)
        return client

    def labels(self, client, name, text, words):
        """What is offered behind some words."""
        client.change(name, text)
        result = client.ask("completion", name, words, len(words))
        return [item["label"] for item in result["items"]]
