# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
