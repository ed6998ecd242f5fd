# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of real robots from their logs: trajectories that excite joints, logs and their quality.

docs/identify.md walks through one robot.
"""

from .channels import Reading
from .delays import Delay, estimate_delays
from .joints import AssetJoint, asset_joints
from .log import Finding, FindingError, Log, LogError
from .log_files import read_log
from .quality import JointQuality, Quality, assess

__all__ = ["AssetJoint", "Delay", "Finding", "FindingError", "JointQuality", "Log", "LogError",
           "Quality", "Reading", "assess", "asset_joints", "estimate_delays", "read_log"]
