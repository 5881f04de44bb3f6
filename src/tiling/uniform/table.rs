//! The tilings that are known, a row each. To add a k-uniform tiling, add its row here
//! and its class to the table of [`super::symmetry`], which proves both.

use super::UniformTiling;

/// All tilings that are known here: the eleven uniform ones, then the twenty 2-uniform
/// ones in the order and with the numbers of Grünbaum and Shephard, section 2.2.
///
/// The origin is where the tiling has most symmetry, as far as that is a vertex or the
/// middle of a polygon with six or twelve sides. Walks: see [`super::walk`].
pub const UNIFORM: &[UniformTiling] = &[
    UniformTiling { name: "3.3.3.3.3.3", translations: ["a", "e"], seeds: "." },
    UniformTiling { name: "4.4.4.4", translations: ["a", "g"], seeds: "." },
    UniformTiling { name: "6.6.6", translations: ["ae", "ei"], seeds: ". a" },
    UniformTiling { name: "3.6.3.6", translations: ["aa", "ee"], seeds: ". a e" },
    UniformTiling { name: "3.4.6.4", translations: ["ace", "egi"], seeds: "a e i m q u" },
    UniformTiling { name: "3.3.3.4.4", translations: ["a", "eg"], seeds: ". g" },
    UniformTiling { name: "3.3.4.3.4", translations: ["ac", "gi"], seeds: ". a e i" },
    UniformTiling { name: "3.3.3.3.6", translations: ["aae", "eei"], seeds: "a e i m q u" },
    UniformTiling { name: "4.8.8", translations: ["adv", "dgj"], seeds: ". d j dj" },
    UniformTiling { name: "3.12.12", translations: ["aacw", "ceeg"], seeds: "ac ce eg gi ik aw" },
    UniformTiling {
        name: "4.6.12",
        translations: ["aaacw", "ceeeg"],
        seeds: "ac ce eg gi ik km mo oq qs su uw aw",
    },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.3.3.6-1",
        translations: ["aaa", "eee"],
        seeds: "a e i m q u ae ei",
    },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.3.3.6-2",
        translations: ["aeee", "eiii"],
        seeds: "a e i m q u ae ei im mq qu au",
    },
    UniformTiling { name: "3.3.3.3.3.3+3.3.3.4.4-1", translations: ["a", "egi"], seeds: ". e q" },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.3.4.4-2",
        translations: ["a", "eegi"],
        seeds: ". e q qu",
    },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.4.3.4",
        translations: ["acw", "ceg"],
        seeds: ". c g k o s w",
    },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.4.12",
        translations: ["aaacw", "ceeeg"],
        seeds: "ac ce eg gi ik km mo oq qs su uw aw ace auw",
    },
    UniformTiling {
        name: "3.3.3.3.3.3+3.3.6.6",
        translations: ["aaa", "eee"],
        seeds: ". a e i m q u",
    },
    UniformTiling { name: "3.3.3.3.6+3.3.6.6", translations: ["cw", "cgg"], seeds: "c g s w" },
    UniformTiling {
        name: "3.3.3.4.4+3.3.4.3.4-1",
        translations: ["bdvx", "dfhj"],
        seeds: ". b f j p v jp pv bd df hj vx",
    },
    UniformTiling {
        name: "3.3.3.4.4+3.3.4.3.4-2",
        translations: ["bx", "ffhh"],
        seeds: ". d h t x nt df fh",
    },
    UniformTiling {
        name: "3.3.3.4.4+3.4.6.4",
        translations: ["aacw", "ceeg"],
        seeds: "c g k o s w ac ce eg ik uw aw",
    },
    UniformTiling { name: "3.3.3.4.4+4.4.4.4-1", translations: ["a", "egg"], seeds: ". g s" },
    UniformTiling { name: "3.3.3.4.4+4.4.4.4-2", translations: ["a", "eggg"], seeds: ". e s eg" },
    UniformTiling {
        name: "3.3.4.3.4+3.4.6.4",
        translations: ["aacw", "ceeg"],
        seeds: "a e i m q u ac ce eg gi ik aw",
    },
    UniformTiling { name: "3.3.6.6+3.6.3.6", translations: ["cw", "gg"], seeds: ". c o" },
    UniformTiling {
        name: "3.4.3.12+3.12.12",
        translations: ["aacw", "eggi"],
        seeds: "ac ce eg gi ik oq uw aw",
    },
    UniformTiling {
        name: "3.4.4.6+3.4.6.4",
        translations: ["aaacw", "ceeeg"],
        seeds: "c g k o s w ac ce eg gi ik km mo oq qs su uw aw",
    },
    UniformTiling { name: "3.4.4.6+3.6.3.6-1", translations: ["aa", "egi"], seeds: "a e i q u" },
    UniformTiling { name: "3.4.4.6+3.6.3.6-2", translations: ["aa", "eeg"], seeds: "a e i q u" },
    UniformTiling {
        name: "3.4.6.4+4.6.12",
        translations: ["aaccww", "cceegg"],
        seeds: "ac ce eg gi ik km mo oq qs su uw aw acc cce egg ikk uww aww",
    },
];
