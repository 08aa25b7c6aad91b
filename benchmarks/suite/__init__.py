# SPDX-License-Identifier: MIT
"""What benchmarks/run does: families of benchmarks, the record of each run, the report from the records."""
