// What kernels ask of a C library, for WebAssembly without one: memory, and functions of numbers.
//
// Kernels count pointers and sizes as 64 bits, as on the machine that Numba compiled them for; only addresses are 32.

#define PAGE 65536u
#define ALIGNMENT 16u

typedef unsigned long long u64;
typedef union { double number; u64 bits; } Double;

extern unsigned char __heap_base;

static unsigned long end; // of the memory that is in use

/** Memory behind all that is in use, which grows in pages; null if the engine has no more. */
void *malloc(u64 size) {
  const u64 start = (end + (ALIGNMENT - 1)) & ~(unsigned long)(ALIGNMENT - 1), stop = start + size;
  if (size > 0xffff0000u || stop > 0xffff0000u) return 0;
  const unsigned long pages = (unsigned long)((stop + PAGE - 1) / PAGE), have = __builtin_wasm_memory_size(0);
  // growing by a quarter more keeps the number of calls small, which are slow in some engines
  const unsigned long spare = have / 4;
  if (pages > have && __builtin_wasm_memory_grow(0, pages - have + spare) == -1ul &&
      __builtin_wasm_memory_grow(0, pages - have) == -1ul) return 0;
  end = (unsigned long)stop;
  return (void *)(unsigned long)start;
}

/** Nothing: `reset` frees all memory at once, after a call. */
void free(void *block) { (void)block; }

/** Free all memory. */
void reset(void) { end = (unsigned long)&__heap_base; }

void *memcpy(void *to, const void *from, unsigned long size) {
  __builtin_memcpy(to, from, size);
  return to;
}

void *memmove(void *to, const void *from, unsigned long size) {
  __builtin_memmove(to, from, size);
  return to;
}

void *memset(void *to, int byte, unsigned long size) {
  __builtin_memset(to, byte, size);
  return to;
}

double sqrt(double value) { return __builtin_sqrt(value); }

/** Two to a whole power, which kernels use for the sides of cells; any other argument is an error of this file. */
double exp2(double power) {
  if (power != __builtin_floor(power) || power < -1022.0 || power > 1023.0) __builtin_trap();
  Double result = {.bits = (u64)(1023 + (int)power) << 52};
  return result.number;
}

/** Fraction in 0.5..1 (with the sign of the value) and exponent of a finite number; 0 has the exponent 0. */
double frexp(double value, int *exponent) {
  Double parts = {value};
  int biased = (int)(parts.bits >> 52) & 0x7ff, shift = 0;
  *exponent = 0;
  if (value == 0.0 || biased == 0x7ff) return value;
  if (biased == 0) { // subnormal
    parts.number *= 0x1p64;
    biased = (int)(parts.bits >> 52) & 0x7ff;
    shift = 64;
  }
  *exponent = biased - 1022 - shift;
  parts.bits = (parts.bits & 0x800fffffffffffffull) | 0x3fe0000000000000ull;
  return parts.number;
}

/** Product of two numbers of 128 bits, of which kernels make random keys; `result` is two words, the lower one first. */
void __multi3(u64 *result, u64 a, u64 a_high, u64 b, u64 b_high) {
  const u64 low = 0xffffffffull, a0 = a & low, a1 = a >> 32, b0 = b & low, b1 = b >> 32;
  const u64 p = a0 * b0, q = a1 * b0, r = a0 * b1, middle = (p >> 32) + (q & low) + (r & low);
  result[0] = (p & low) | (middle << 32);
  result[1] = a1 * b1 + (q >> 32) + (r >> 32) + (middle >> 32) + a * b_high + a_high * b;
}
