; Rounds through a plant: gauges to read, valves to close and open, pumps to stop and start. Lengths are whole millimetres.
(define (domain cadgraph-round)
  (:requirements :strips :typing :action-costs)
  (:types spot unit task stage count - object
          gauge valve pump - unit)
  (:constants none - count)
  (:predicates
    (at ?s - spot)                        ; where one is
    (walkable ?a ?b - spot)               ; both on one level
    (climbable ?a ?b - spot)              ; ends of the same stairs or ladder
    (works-at ?u - unit ?s - spot)        ; where one stands to work at a unit
    (within-reach ?u - unit)
    (out-of-reach ?u - unit)              ; takes a ladder or lift
    (is-open ?v - valve)
    (is-shut ?v - valve)
    (runs ?p - pump)
    (is-stopped ?p - pump)
    (to-read ?t - task ?g - gauge)
    (to-close ?t - task ?v - valve)
    (to-open ?t - task ?v - valve)
    (to-stop ?t - task ?p - pump)
    (to-start ?t - task ?p - pump)
    (belongs ?t - task ?k - stage)        ; and is not done yet
    (done ?t - task)
    (now ?k - stage)
    (follows ?k ?l - stage)
    (last ?k - stage)
    (left ?k - stage ?n - count)          ; tasks of a stage that are not done yet
    (one-less ?m ?n - count)              ; m = n - 1
    (may-end-at ?s - spot)
    (ended))
  (:functions
    (total-cost) - number
    (distance ?a ?b - spot) - number)
  (:action walk
    :parameters (?a ?b - spot)
    :precondition (and (at ?a) (walkable ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (increase (total-cost) (distance ?a ?b))))
  (:action climb
    :parameters (?a ?b - spot)
    :precondition (and (at ?a) (climbable ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (increase (total-cost) (distance ?a ?b))))
  (:action set-up
    :parameters (?u - unit ?s - spot)
    :precondition (and (at ?s) (works-at ?u ?s) (out-of-reach ?u))
    :effect (and (not (out-of-reach ?u)) (within-reach ?u)))
  (:action read
    :parameters (?t - task ?g - gauge ?s - spot ?k - stage ?n ?m - count)
    :precondition (and (at ?s) (works-at ?g ?s) (within-reach ?g) (to-read ?t ?g)
                       (belongs ?t ?k) (now ?k) (left ?k ?n) (one-less ?m ?n))
    :effect (and (done ?t) (not (belongs ?t ?k)) (not (left ?k ?n)) (left ?k ?m)))
  (:action close
    :parameters (?t - task ?v - valve ?s - spot ?k - stage ?n ?m - count)
    :precondition (and (at ?s) (works-at ?v ?s) (within-reach ?v) (to-close ?t ?v) (is-open ?v)
                       (belongs ?t ?k) (now ?k) (left ?k ?n) (one-less ?m ?n))
    :effect (and (done ?t) (not (belongs ?t ?k)) (not (left ?k ?n)) (left ?k ?m)
                 (not (is-open ?v)) (is-shut ?v)))
  (:action open
    :parameters (?t - task ?v - valve ?s - spot ?k - stage ?n ?m - count)
    :precondition (and (at ?s) (works-at ?v ?s) (within-reach ?v) (to-open ?t ?v) (is-shut ?v)
                       (belongs ?t ?k) (now ?k) (left ?k ?n) (one-less ?m ?n))
    :effect (and (done ?t) (not (belongs ?t ?k)) (not (left ?k ?n)) (left ?k ?m)
                 (not (is-shut ?v)) (is-open ?v)))
  (:action stop
    :parameters (?t - task ?p - pump ?s - spot ?k - stage ?n ?m - count)
    :precondition (and (at ?s) (works-at ?p ?s) (within-reach ?p) (to-stop ?t ?p) (runs ?p)
                       (belongs ?t ?k) (now ?k) (left ?k ?n) (one-less ?m ?n))
    :effect (and (done ?t) (not (belongs ?t ?k)) (not (left ?k ?n)) (left ?k ?m)
                 (not (runs ?p)) (is-stopped ?p)))
  (:action start
    :parameters (?t - task ?p - pump ?s - spot ?k - stage ?n ?m - count)
    :precondition (and (at ?s) (works-at ?p ?s) (within-reach ?p) (to-start ?t ?p) (is-stopped ?p)
                       (belongs ?t ?k) (now ?k) (left ?k ?n) (one-less ?m ?n))
    :effect (and (done ?t) (not (belongs ?t ?k)) (not (left ?k ?n)) (left ?k ?m)
                 (not (is-stopped ?p)) (runs ?p)))
  (:action next-stage
    :parameters (?k ?l - stage)
    :precondition (and (now ?k) (left ?k none) (follows ?k ?l))
    :effect (and (not (now ?k)) (now ?l)))
  (:action end
    :parameters (?s - spot ?k - stage)
    :precondition (and (at ?s) (may-end-at ?s) (now ?k) (last ?k) (left ?k none))
    :effect (and (not (at ?s)) (ended))))
