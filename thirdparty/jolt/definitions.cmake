# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
#
# What Jolt and all that includes its headers are compiled with; its inline functions and the
# layout of its classes depend on it.
# Asserts stay off (JPH_ENABLE_ASSERTS): what they ask of arguments the adapter keeps to.
# JPH_DOUBLE_PRECISION: positions in double precision, so that a body loses none of its motion far
# from the origin or in small steps; all that is relative to a body stays in single precision.
# JPH_CROSS_PLATFORM_DETERMINISTIC: the same bits from every compiler and processor.
# JPH_DISABLE_CUSTOM_ALLOCATOR: the memory of C++, which sanitizers watch.
# No instructions beyond SSE2: the library runs wherever tenon does.
set(TENON_JOLT_DEFINITIONS JPH_DOUBLE_PRECISION JPH_CROSS_PLATFORM_DETERMINISTIC
                           JPH_OBJECT_LAYER_BITS=16 JPH_DISABLE_CUSTOM_ALLOCATOR)
