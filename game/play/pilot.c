#include "game/play/pilot.h"
#include "engine/core/angle.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/play/pilot_internal.h"
#include <math.h>
#include <string.h>

static const double units = 65536.0 / (2.0 * NOOK_PI); /* of inputs, a radian */

static const double turn_most = 0.05;     /* radians a tick: as a hand moves a mouse */
static const double turn_part = 0.2;      /* of what is left to turn in a tick, so that turns end gently */
static const double turn_least = 0.002;   /* radians a tick */
static const double aim_close = 0.004;    /* radians: looks there */
static const double heading_close = 0.02; /* radians: goes straight on, so that a way is one long run of equal inputs */
static const double there = 0.1;          /* metres */
static const double take_from = 1.5;      /* metres, level: from where things are taken */
static const double place_close = 0.06;   /* metres */
static const double slow_from = 0.5;      /* metres before the end of a way, where one slows down */

/* One tick: what is seen, and what is to be pressed. */
typedef struct moment {
    nook_pilot *pilot;
    const pilot_step *step;
    const nook_session *session;
    nook_session_view view;
    nook_play_input *out;
} moment;

/* ---- Turning ----------------------------------------------------------------------------------------------------- */

static double wrapped(double angle)
{
    return angle - 2.0 * NOOK_PI * floor((angle + NOOK_PI) / (2.0 * NOOK_PI));
}

static int16_t turn_units(double radians)
{
    double most = fmin(turn_most, fmax(turn_least, turn_part * fabs(radians)));
    return (int16_t)lround(fmax(-most, fmin(most, radians)) * units);
}

/* @return whether it looks that way, to within `close` */
static bool turn_to(moment *m, double yaw, double pitch, double close)
{
    double left = wrapped(yaw - m->view.yaw), up = pitch - m->view.pitch;
    bool done = fabs(left) <= close && fabs(up) <= close;
    if (!done) {
        m->out->yaw = turn_units(left);
        m->out->pitch = turn_units(up);
    }
    return done;
}

static double yaw_towards(const moment *m, double x, double z)
{
    return atan2(m->view.eyes[0] - x, m->view.eyes[2] - z);
}

static bool look_at(moment *m, const double target[3])
{
    double dx = target[0] - m->view.eyes[0], dy = target[1] - m->view.eyes[1], dz = target[2] - m->view.eyes[2];
    double pitch = fmax(-1.5, fmin(1.5, atan2(dy, hypot(dx, dz))));
    return turn_to(m, yaw_towards(m, target[0], target[2]), pitch, aim_close);
}

/* ---- Going ------------------------------------------------------------------------------------------------------- */

static double distance_to(const moment *m, double x, double z)
{
    return hypot(x - m->view.feet[0], z - m->view.feet[2]);
}

/* Looks ahead a little downwards or as given, and goes. @return whether it is there */
static bool go_to(moment *m, double x, double z, double pitch, bool runs, double close)
{
    double distance = distance_to(m, x, z);
    if (distance <= close)
        return true;
    double yaw = yaw_towards(m, x, z), off = fabs(wrapped(yaw - m->view.yaw));
    /* Near the end every centimetre aside is a large angle: no more turning than it takes. */
    turn_to(m, yaw, pitch, fmin(heading_close + 0.02 / distance, 0.3));
    if (off < 0.5) {
        m->out->forward = distance < slow_from ? (int8_t)fmax(25.0, 127.0 * distance / slow_from) : 127;
        if (runs && distance > 1.5 && off < 0.2)
            m->out->buttons |= NOOK_PLAY_RUN;
    }
    return false;
}

/* Without turning: steps to where x, z is `distance` straight ahead. @return whether it stands there */
static bool shift_to(moment *m, double x, double z, double distance, double close)
{
    double sine = sin(m->view.yaw), cosine = cos(m->view.yaw);
    double dx = x + distance * sine - m->view.feet[0], dz = z + distance * cosine - m->view.feet[2];
    double forward = -dx * sine - dz * cosine, right = dx * cosine - dz * sine;
    double length = hypot(forward, right);
    if (length <= close)
        return true;
    double speed = fmin(127.0, fmax(12.0, 127.0 * length / slow_from));
    m->out->forward = (int8_t)(speed * forward / length);
    m->out->right = (int8_t)(speed * right / length);
    return false;
}

/* ---- Steps: each gives true when it is done ---------------------------------------------------------------------- */

static bool step_go(moment *m)
{
    return go_to(m, m->step->numbers[0], m->step->numbers[1], 0.0, m->step->verb == PILOT_RUN_TO, there);
}

static bool step_look(moment *m)
{
    double target[3];
    memcpy(target, m->step->numbers, sizeof target);
    if (*m->step->name && !nook_session_middle_of(m->session, m->step->name, target))
        return false;
    return look_at(m, target);
}

static bool step_turn(moment *m)
{
    return turn_to(m, m->step->numbers[0] * NOOK_DEGREE, m->step->numbers[1] * NOOK_DEGREE, aim_close);
}

static bool step_take(moment *m)
{
    double middle[3];
    if (strcmp(m->view.carried, m->step->name) == 0)
        return true;
    if (!nook_session_middle_of(m->session, m->step->name, middle))
        return false;
    double pitch = fmax(-1.2, fmin(1.2, atan2(middle[1] - m->view.eyes[1], take_from)));
    bool near = hypot(middle[0] - m->view.feet[0], middle[2] - m->view.feet[2]) < take_from ||
                go_to(m, middle[0], middle[2], pitch, false, take_from);
    if (near)
        look_at(m, middle); /* which may move: to be looked at will do */
    if (near && strcmp(m->view.looked_at, m->step->name) == 0 && m->pilot->ticks % 8 == 0)
        m->out->buttons |= NOOK_PLAY_TAKE;
    return false;
}

/* Brings what is carried over the place, lowers it by looking down, and lets go when it rests or hangs there. */
static bool step_place(moment *m)
{
    enum { COME, AIM, LOWER, LET_GO };
    const double *to = m->step->numbers;
    double middle[3] = { 0, 0, 0 }, distance = m->view.hold_distance;
    if (m->pilot->phase == LET_GO)
        return !*m->view.carried;
    if (!*m->view.carried || !nook_session_middle_of(m->session, m->view.carried, middle))
        return false; /* it slipped away: time will run out */
    double pitch = atan2(to[1] + m->view.hold_below - m->view.eyes[1], distance);
    double high = atan2(to[1] + 0.35 + m->view.hold_below - m->view.eyes[1], distance);
    if (m->pilot->phase == COME) {
        m->pilot->phase += go_to(m, to[0], to[2], fmax(high, -0.3), false, distance + 0.3);
    } else if (m->pilot->phase == AIM) {
        bool turned = turn_to(m, yaw_towards(m, to[0], to[2]), high, aim_close);
        m->pilot->phase += turned && shift_to(m, to[0], to[2], distance, 0.02);
    } else if (m->pilot->phase == LOWER) {
        double off = hypot(middle[0] - to[0], middle[2] - to[2]);
        bool looks = turn_to(m, m->view.yaw, fmax(pitch, m->view.pitch - 0.02), aim_close);
        bool close = looks && off < place_close && fabs(m->view.pitch - pitch) < 2.0 * aim_close;
        shift_to(m, to[0], to[2], distance, 0.02);
        m->pilot->settled = close ? m->pilot->settled + 1 : 0;
        if (m->pilot->settled > 20) {
            m->out->buttons |= NOOK_PLAY_TAKE;
            m->pilot->phase = LET_GO;
        }
    }
    return false;
}

static bool step_spin(moment *m)
{
    double left = m->step->numbers[0] - m->pilot->spun;
    int16_t turn = turn_units(fmax(-0.05, fmin(0.05, left * NOOK_DEGREE)));
    m->pilot->spun += turn / units / NOOK_DEGREE;
    m->out->yaw = turn;
    m->out->buttons |= NOOK_PLAY_TURN;
    return fabs(left) < 0.05;
}

/* Presses once. */
static bool step_press(moment *m, uint16_t button)
{
    if (m->pilot->ticks == 0)
        m->out->buttons |= button;
    return m->pilot->ticks > 0;
}

static bool step_wait_for(const moment *m)
{
    return nook_session_state_of(m->session, m->step->name) >= m->step->numbers[0];
}

static bool do_step(moment *m)
{
    switch (m->step->verb) {
    case PILOT_WALK_TO:
    case PILOT_RUN_TO:
        return step_go(m);
    case PILOT_LOOK_AT:
        return step_look(m);
    case PILOT_TURN_TO:
        return step_turn(m);
    case PILOT_TAKE:
        return step_take(m);
    case PILOT_PLACE_AT:
        return step_place(m);
    case PILOT_SPIN:
        return step_spin(m);
    case PILOT_DROP:
        return step_press(m, NOOK_PLAY_TAKE);
    case PILOT_THROW:
        return step_press(m, NOOK_PLAY_THROW);
    case PILOT_JUMP:
        return step_press(m, NOOK_PLAY_JUMP);
    case PILOT_RESTART:
        return step_press(m, NOOK_PLAY_RESTART);
    case PILOT_CROUCH:
    case PILOT_STAND:
        m->pilot->crouched = m->step->verb == PILOT_CROUCH;
        return true;
    case PILOT_WAIT:
        return m->pilot->ticks * NOOK_PHYSICS_STEP >= m->step->numbers[0];
    case PILOT_WAIT_FOR:
        return step_wait_for(m);
    }
    return true;
}

/* ---- The script -------------------------------------------------------------------------------------------------- */

static void say_failure(const moment *m)
{
    const nook_session_view *v = &m->view;
    nook_log_at(
        __FILE__, __LINE__, NOOK_LOG_ERROR,
        "%s:%u: %s: not done within %g s; at %.2f %.2f %.2f, looking %.0f %.0f degrees at \"%s\", carrying \"%s\"",
        m->pilot->file, m->step->line, m->step->text, m->step->seconds, v->feet[0], v->feet[1], v->feet[2],
        v->yaw / NOOK_DEGREE, v->pitch / NOOK_DEGREE, v->looked_at, v->carried);
}

static void next_step(nook_pilot *pilot)
{
    pilot->at++;
    pilot->ticks = pilot->phase = pilot->settled = 0;
    pilot->spun = 0.0;
}

nook_pilot_status nook_pilot_steer(nook_pilot *pilot, const nook_session *session, nook_play_input *out_input)
{
    *out_input = (nook_play_input){ 0 };
    if (pilot->failed)
        return NOOK_PILOT_FAILED;
    if (pilot->at == pilot->step_count)
        return NOOK_PILOT_DONE;
    moment m = { pilot, &pilot->steps[pilot->at], session, nook_session_look(session), out_input };
    bool done = do_step(&m);
    if (pilot->crouched)
        out_input->buttons |= NOOK_PLAY_CROUCH;
    if (done) {
        next_step(pilot);
    } else if (++pilot->ticks * NOOK_PHYSICS_STEP > m.step->seconds) {
        say_failure(&m);
        pilot->failed = true;
        return NOOK_PILOT_FAILED;
    }
    return NOOK_PILOT_STEERS;
}
