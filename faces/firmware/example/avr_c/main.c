/* SPDX-License-Identifier: Apache-2.0 */
/* A six-step current controller as it is often written for an AVR: in C with avr-libc, with integers of mA and timer
 * counts, and with tables indexed by the Hall code. It uses no file of sixstep; map.toml describes how it is
 * connected to the board.
 *
 * NEVER USE IT WITH A REAL BRIDGE. It only shows how a user's own firmware is connected to the simulated board. No
 * over-current and no broken wire stops it. It has no watchdog, and it starts by itself, even after a wrong Hall
 * code. Firmware for a real bridge is in ../avr.
 *
 * ATmega2560 at 16 MHz. Timer 1 counts up and down in 100 us. Upper gates of legs a, b, c are at OC1C, OC1B, OC1A
 * (PB7, PB6, PB5), lower gates at PC3, PC4, PC5, Hall lines H1 H2 H3 at PK4, PK5, PK6. Each phase has a transducer
 * at ADC4..ADC6 (10 A over 1024 counts, 0 A in the middle). The setpoint's potentiometer is at ADC7 (2 A in either
 * direction). */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#define TOP 800 /* counts of half a period */
#define DEAD 16 /* cycles from turning a gate off to turning another gate on: 1 us */
#define MA(counts) (((int32_t)((int16_t)(counts)-512) * 625) >> 6) /* 9.77 mA a count */
#define SETPOINT_MA(counts) (((int32_t)((int16_t)(counts)-512) * 125) >> 5) /* 3.9 mA a count */
/* u = kp e + sum of ki e. u: duty in timer counts; e: error of the current in mA; kp, ki in Q12: 2.3 V/A and 0.38
   V/A at 24 V (sixstep design --method cancellation). */
#define KP 315
#define KI 52
#define FULL ((int32_t)TOP << 12)

/* Tables indexed by PK6..PK4 as a number, with H1 as the lowest bit: the leg from which a positive current flows
   into the motor, and the leg into which it returns; 3: none. */
static const uint8_t feeds[8] = {3, 0, 1, 0, 2, 2, 1, 3};
static const uint8_t takes[8] = {3, 1, 2, 2, 0, 1, 0, 3};
static const uint8_t upper[3] = {1 << PB7, 1 << PB6, 1 << PB5};
static const uint8_t lower[3] = {1 << PC3, 1 << PC4, 1 << PC5};

static int32_t integral; /* Q12 */
static int16_t drive;    /* signed duty in timer counts */

static uint8_t hall(void) { return (PINK >> 4) & 7; }

/* The three outputs of the timer always have pulses, and the direction register enables one output. Between turning
 * a gate off and turning another gate on, all gates are off for the dead time. Call this function within interrupts
 * only. */
static void set_gates(uint8_t code)
{
    uint8_t from = drive < 0 ? takes[code] : feeds[code];
    uint8_t to = drive < 0 ? feeds[code] : takes[code];
    uint8_t up = from > 2 || drive == 0 ? 0 : upper[from];
    uint8_t low = to > 2 ? 0 : lower[to];
    uint8_t up_stays = DDRB & up, low_stays = PORTC & low;
    DDRB = up_stays;
    PORTC = low_stays;
    if (up_stays != up || low_stays != low) __builtin_avr_delay_cycles(DEAD);
    DDRB = up;
    PORTC = low;
}

static uint16_t convert(uint8_t channel)
{
    ADMUX = (1 << REFS0) | channel;
    ADCSRA = (1 << ADEN) | (1 << ADPS2) | (1 << ADSC);
    while (ADCSRA & (1 << ADSC))
        ;
    return ADC;
}

ISR(ADC_vect)
{
    uint16_t counts = ADC;
    uint8_t code = hall();
    int32_t error = SETPOINT_MA(convert(7)) - MA(counts);
    int32_t u;

    integral += KI * error;
    if (integral > FULL) integral = FULL;
    if (integral < -FULL) integral = -FULL;
    u = (integral + KP * error) >> 12;
    drive = u > TOP ? TOP : u < -TOP ? -TOP : (int16_t)u;
    OCR1A = OCR1B = OCR1C = drive < 0 ? -drive : drive;

    ADMUX = (1 << REFS0) | (feeds[code] > 2 ? 4 : 4 + feeds[code]);
    ADCSRA = (1 << ADEN) | (1 << ADATE) | (1 << ADIE) | (1 << ADIF) | (1 << ADPS2);
    TIFR1 = 1 << TOV1;
    set_gates(hall());
}

ISR(PCINT2_vect)
{
    uint8_t code = hall();
    ADMUX = (1 << REFS0) | (feeds[code] > 2 ? 4 : 4 + feeds[code]);
    set_gates(code);
}

int main(void)
{
    DDRC = (1 << PC3) | (1 << PC4) | (1 << PC5);
    ICR1 = TOP;
    TCCR1A = (1 << COM1A1) | (1 << COM1B1) | (1 << COM1C1) | (1 << WGM11);
    TCCR1B = (1 << WGM13) | (1 << CS10);
    PCMSK2 = 0x70;
    PCICR = 1 << PCIE2;
    ADCSRB = (1 << ADTS2) | (1 << ADTS1); /* trigger: timer 1's overflow, at its bottom */
    ADMUX = (1 << REFS0) | 4;
    ADCSRA = (1 << ADEN) | (1 << ADATE) | (1 << ADIE) | (1 << ADPS2);
    TIFR1 = 1 << TOV1; /* only the flag's rising edge triggers a conversion: a flag that is already set would prevent
                          it */
    set_sleep_mode(SLEEP_MODE_IDLE);
    sei();
    for (;;) sleep_mode();
}
