# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Codes of features of Robot-Body that assets of tenon do not have: others replace them."""

# Materials of MDL and OpenPBR beside UsdPreviewSurface, display colours beside materials, nodes of
# the ROS 2 bridge.
OTHER_CHOICES = {"DISP.001", "ROS.001", "VM.MDL.003", "VM.PBR.001"}
