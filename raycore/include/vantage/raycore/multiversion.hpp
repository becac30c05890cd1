#pragma once

/// Put before a hot kernel of ours: it is compiled for several instruction sets, and the best one
/// that the machine has is chosen when the program is loaded. With -ffp-contract=off all of them
/// give the same bits.
#if defined(VANTAGE_ONE_INSTRUCTION_SET) || !defined(__x86_64__)
#define VANTAGE_MULTIVERSION
#else
#define VANTAGE_MULTIVERSION __attribute__((target_clones("default", "avx2", "avx512f")))
#endif
