"""Pictures of an environment: arrays, texts, a window, a notebook's output."""

from __future__ import annotations

import base64
import os
from typing import Any

import numpy as np
from gymnasium.error import DependencyNotInstalled
from numpy.typing import NDArray

from . import _native
from .errors import Error


class Renderer:
    """Draws the episode of a batch's first environment as far as it goes."""

    def __init__(
        self, simulator: _native.Simulator, size: tuple[int, int], visualizer: str, fps: int
    ) -> None:
        """size: width and height in pixels, 16 to 8192 each. visualizer: one of `rddl render
        --visualizer list`, or "" for the one that suits the problem."""
        self._painter = _native.Painter(simulator, *size, visualizer)
        self._size, self._fps = size, fps
        self._window: Any = None
        self._clock: Any = None

    def begin(self, batch: _native.EnvPool, horizon: int) -> None:
        self._painter.begin(batch, horizon)

    def add_step(self, batch: _native.EnvPool, end: str) -> None:
        self._painter.add_step(batch, end)

    def pixels(self) -> NDArray[np.uint8]:
        """(height, width, 3)"""
        return self._painter.pixels()

    def text(self) -> str:
        """A line for each fluent."""
        return self._painter.text()

    def image_tag(self) -> str:
        """An HTML image that holds its picture."""
        data = base64.b64encode(self._painter.png()).decode()
        return f'<img alt="state" src="data:image/png;base64,{data}">'

    def page(self) -> str:
        """The replay page of the episode (docs/pictures.md): an HTML file of its own."""
        return self._painter.page(float(self._fps))

    def write_gif(self, path: str | bytes | os.PathLike[str]) -> None:
        """A movie of the episode."""
        self._painter.write_gif(path, float(self._fps))

    def show(self) -> None:
        """Draws into a window."""
        try:
            import pygame
        except ImportError as missing:
            raise DependencyNotInstalled(
                "render_mode='human' shows a window with pygame: pip install pygame-ce"
            ) from missing
        if self._window is None:
            # SDL would otherwise catch SIGTERM, which then no longer ends the process, nor its
            # forks.
            os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
            try:
                pygame.display.init()
                self._window = pygame.display.set_mode(self._size)
            except pygame.error as refused:
                raise Error(
                    f"render_mode='human' cannot open a window ({refused}); "
                    "'rgb_array' needs none"
                ) from refused
            self._clock = pygame.time.Clock()
        frame = np.swapaxes(self.pixels(), 0, 1)
        pygame.surfarray.blit_array(self._window, frame)
        pygame.event.pump()
        pygame.display.flip()
        self._clock.tick(self._fps)

    def close(self) -> None:
        if self._window is not None:
            import pygame

            pygame.display.quit()
            self._window = None
