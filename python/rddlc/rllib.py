"""`rddlc.adapters.rllib`, under the name that programs use."""

from .adapters.rllib import FORMS, NAME, create_env, env_config

__all__ = ["FORMS", "NAME", "create_env", "env_config"]
