/* A program for a bare Cortex-M7, without C library and operating system: attaches the basis that
 * lies in its flash memory, morphs, takes the admissible step and the adjoint, and says the
 * checksum and how much memory that took, through the debugger's channel (semihosting). See
 * tests/release/cortex.sh. */
#include "case.h"

extern const unsigned char basis_begin[], basis_end[]; /* basis.S */
extern uint32_t data_from[], data_begin[], data_end[], bss_begin[], bss_end[],
    stack_top[]; /* cortex.ld */

static case_memory memory;

static int32_t ask_host(int32_t operation, const void* what) {
    register int32_t result __asm__("r0") = operation;
    register const void* argument __asm__("r1") = what;
    __asm__ volatile("bkpt 0xab" : "+r"(result) : "r"(argument) : "memory");
    return result;
}
static void say(const char* text) { ask_host(4, text); } /* SYS_WRITE0 */
static void leave(int done) {
    ask_host(0x18,
             (const void*)(done ? 0x20026
                                : 0x20023)); /* SYS_EXIT: application exit, or run-time error */
    for (;;) {}
}
static void say_number(uint64_t number, unsigned base, int digits) {
    char text[24];
    int at = 23;
    text[at] = 0;
    for (; at > 0 && (digits > 0 || number > 0); --digits, number /= base)
        text[--at] = "0123456789abcdef"[number % base];
    say(text + at);
}

static const uint32_t paint = 0xa5a5a5a5u;

static void run(void) {
    const hm_mesh mesh = make_mesh(&memory);
    hm_error error = {HM_OK};
    uint64_t sum = 0;
    uint32_t* untouched = bss_end;
    if (use_basis(basis_begin, (size_t)(basis_end - basis_begin), &mesh, &memory, &sum, &error) !=
        HM_OK) {
        say("refused: "), say(error.text), say("\n");
        leave(0);
    }
    while (untouched < stack_top && *untouched == paint) ++untouched;
    say("attached, single precision, use: "), say_number(sum, 16, 16), say("\n");
    say_number((uint64_t)((char*)bss_end - (char*)data_begin), 10, 1), say(" bytes of data, ");
    say_number((uint64_t)((char*)stack_top - (char*)untouched), 10, 1), say(" bytes of stack\n");
    leave(1);
}

/* Where the processor begins: the floating-point unit is switched on, memory is set up, the stack
 * is painted so that its use can be measured. */
static void start(void) {
    uint32_t* to;
    const uint32_t* from = data_from;
    *(volatile uint32_t*)0xE000ED88 |= 0xFu << 20; /* CPACR: coprocessors 10 and 11 */
    __asm__ volatile("dsb\n isb");
    for (to = data_begin; to < data_end;) *to++ = *from++;
    for (to = bss_begin; to < bss_end;) *to++ = 0;
    for (to = bss_end; to < (uint32_t*)__builtin_frame_address(0) - 16;) *to++ = paint;
    run();
}
static void fault(void) {
    say("the processor reports a fault\n");
    leave(0);
}

typedef void (*vector)(void);
extern const vector vectors[16];
__attribute__((section(".vectors"), used))
const vector vectors[16] = {(vector)stack_top, start, fault, fault, fault, fault, fault};
