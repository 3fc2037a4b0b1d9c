(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The nerve theorem: a common point of the cells Pos of some sites means that a choice puts these sites on the circle
   of an empty disc; the same for half-planes, the centres at infinity.
   A simplex is given by the set S of its sites: a pair, a triangle, or any number of them. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Neighbours.
Open Scope R_scope.

(* The sites of S can share the centre c. *)
Definition possible_at (N : nat) (B : sites) (S : nat -> Prop) (c : point) : Prop :=
  forall i, (i < N)%nat -> S i -> pos N B i c.

(* The sites of S share a centre at infinity in direction u: some line across u meets all of their rectangles, or
   has them beyond, and no rectangle lies wholly beyond it. *)
Definition possible_far (N : nat) (B : sites) (S : nat -> Prop) (u : point) : Prop :=
  u <> (0, 0) /\ forall i k, (i < N)%nat -> S i -> (k < N)%nat ->
    dot u (lowest u (B k)) <= dot u (highest u (B i)).

(* Empty discs and half-planes through the points of S. *)
Definition empty_disc (N : nat) (p : nat -> point) (S : nat -> Prop) (c : point) (r : R) : Prop :=
  (forall i, (i < N)%nat -> S i -> dist c (p i) = r) /\ (forall k, (k < N)%nat -> r <= dist c (p k)).
Definition empty_half_plane (N : nat) (p : nat -> point) (S : nat -> Prop) (u : point) (m : R) : Prop :=
  u <> (0, 0) /\
  (forall i, (i < N)%nat -> S i -> dot u (p i) = m) /\ (forall k, (k < N)%nat -> dot u (p k) <= m).

Lemma disc_shows_possible N B S p c r : choice N B p -> empty_disc N p S c r -> possible_at N B S c.
Proof.
  intros P [H G] i I Si k K. pose proof (ds_le c _ _ (P i I)). pose proof (le_dl c _ _ (P k K)).
  pose proof (H i I Si). pose proof (G k K). lra.
Qed.

Lemma common_centre_gives_disc N B S c : (exists i, (i < N)%nat /\ S i) -> possible_at N B S c ->
  exists p r, choice N B p /\ empty_disc N p S c r /\ 0 <= r /\ exists i, (i < N)%nat /\ S i /\ r = ds c (B i).
Proof.
  intros E H. destruct (finite_max S (fun i => ds c (B i)) N E) as [m [M [Sm L]]]. set (r := ds c (B m)).
  set (good k z := inside z (B k) /\ (S k -> dist c z = r) /\ r <= dist c z).
  destruct (finite_choice (0, 0) good N) as [p P].
  { intros k K. pose proof (H m M Sm k K) as D. fold r in D. destruct (classic (S k)) as [Y | Y].
    - destruct (circle_meets_rect c (B k) r) as [z [Z D']]; [split; [now apply L | exact D] |].
      exists z. split; [exact Z |]. split; [now intros | lra].
    - exists (farthest c (B k)). split; [apply farthest_inside |]. split; [now intros | exact D]. }
  exists p, r. split; [intros k K; now apply (P k K) |]. split; [split |]; [| | split].
  - intros i I Si. now apply (P i I).
  - intros k K. now apply (P k K).
  - apply ds_nonneg.
  - now exists m.
Qed.

(* A disc of radius 0 can be replaced by one with a positive radius, since the sites are finitely many. *)
Lemma positive_disc N p S c : empty_disc N p S c 0 -> exists c' r, 0 < r /\ empty_disc N p S c' r.
Proof.
  intros [H _].
  destruct (small_finite (fun k d => p k <> c -> 2 * d <= dist c (p k)) N) as [r [Pr L]].
  { intros k K. destruct (classic (p k = c)) as [Y | Y].
    - exists 1. split; [lra |]. now intros.
    - assert (0 < dist c (p k)) by (apply dist_pos; congruence).
      exists (dist c (p k) / 2). split; [lra |]. intros. lra. }
  set (c' := (fst c + r, snd c)).
  assert (E : dist c' c = r).
  { unfold dist, dist2, c'. simpl.
    replace (_ + _) with (r * r) by ring. apply sqrt_square. lra. }
  exists c', r. split; [exact Pr |]. split.
  - intros i I Si. rewrite <- (dist_zero c (p i)) by now apply H. exact E.
  - intros k K. destruct (classic (p k = c)) as [-> | Y]; [lra |].
    pose proof (L r (conj Pr (Rle_refl r)) k K Y). pose proof (dist_triangle c c' (p k)).
    rewrite (dist_sym c c') in *. lra.
Qed.

(* The nerve theorem for finite centres. *)
Theorem nerve N B S : (exists i, (i < N)%nat /\ S i) ->
  ((exists c, possible_at N B S c) <->
   (exists p c r, choice N B p /\ 0 < r /\ empty_disc N p S c r)).
Proof.
  intros E. split.
  - intros [c H]. destruct (common_centre_gives_disc N B S c E H) as [p [r [P [D [R0 _]]]]].
    destruct (Rle_lt_or_eq_dec 0 r R0) as [Pr | Z].
    + now exists p, c, r.
    + subst. destruct (positive_disc N p S c D) as [c' [r [Pr D']]]. now exists p, c', r.
  - intros [p [c [r [P [_ D]]]]]. exists c. now apply disc_shows_possible with p r.
Qed.

Lemma dot_mix u t a b : dot u (mix t a b) = (1 - t) * dot u a + t * dot u b.
Proof. unfold dot, mix. simpl. ring. Qed.

(* A line between the lowest and the highest point of a rectangle meets it. *)
Lemma line_meets_rect u B m : dot u (lowest u B) <= m <= dot u (highest u B) -> exists z, inside z B /\ dot u z = m.
Proof.
  intros [A C]. destruct (lowest_spec u B) as [LI _]. destruct (highest_spec u B) as [HI _].
  set (a := dot u (lowest u B)) in *. set (b := dot u (highest u B)) in *.
  destruct (Req_dec a b) as [E | E].
  - exists (lowest u B). split; [exact LI |]. fold a. lra.
  - exists (mix ((m - a) / (b - a)) (lowest u B) (highest u B)). split.
    + apply inside_convex; [| exact LI | exact HI]. assert (0 < b - a) by lra. split.
      * apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat].
      * apply (Rmult_le_reg_r (b - a)); [lra |]. replace ((m - a) / (b - a) * (b - a)) with (m - a) by (field; lra). lra.
    + rewrite dot_mix. fold a b. field. lra.
Qed.

(* The nerve theorem for centres at infinity. *)
Theorem nerve_far N B S : (exists i, (i < N)%nat /\ S i) ->
  ((exists u, possible_far N B S u) <->
   (exists p u m, choice N B p /\ empty_half_plane N p S u m)).
Proof.
  intros E. split.
  - intros [u [U H]]. destruct (finite_min S (fun i => dot u (highest u (B i))) N E) as [m [M [Sm L]]].
    set (h := dot u (highest u (B m))).
    set (good k z := inside z (B k) /\ (S k -> dot u z = h) /\ dot u z <= h).
    destruct (finite_choice (0, 0) good N) as [p P].
    { intros k K. pose proof (H m k M Sm K) as D. fold h in D. destruct (classic (S k)) as [Y | Y].
      - destruct (line_meets_rect u (B k) h) as [z [Z D']]; [split; [exact D | now apply L] |].
        exists z. split; [exact Z |]. split; [now intros | lra].
      - exists (lowest u (B k)). split; [apply lowest_spec |]. split; [now intros | exact D]. }
    exists p, u, h. split; [intros k K; now apply (P k K) |]. split; [exact U |]. split.
    + intros i I Si. now apply (P i I).
    + intros k K. now apply (P k K).
  - intros [p [u [m [P [U [H G]]]]]]. exists u. split; [exact U |]. intros i k I Si K.
    destruct (lowest_spec u (B k)) as [_ A]. destruct (highest_spec u (B i)) as [_ C].
    pose proof (A _ (P k K)). pose proof (C _ (P i I)). pose proof (H i I Si). pose proof (G k K). lra.
Qed.

(* Pairs (mathematics: section 3): the definition asks for the other sites only. The two definitions agree. *)
Definition pair (i j : nat) (k : nat) : Prop := k = i \/ k = j.
Definition others_allow (N : nat) (B : sites) (i j : nat) (c : point) : Prop :=
  forall k, (k < N)%nat -> k <> i -> k <> j -> ds c (B i) <= dl c (B k) /\ ds c (B j) <= dl c (B k).

Lemma move_to_farther N B i j c : (i < N)%nat -> (j < N)%nat -> ds c (B j) <= ds c (B i) ->
  others_allow N B i j c -> exists c', possible_at N B (pair i j) c'.
Proof.
  intros I J L H. destruct (Rle_dec (ds c (B i)) (dl c (B j))) as [Y | Y].
  - exists c. intros m M [-> | ->] k K; (destruct (Nat.eq_dec k i) as [-> | Di];
      [| destruct (Nat.eq_dec k j) as [-> | Dj]; [| destruct (H k K Di Dj)]]);
      pose proof (ds_le_dl c (B i)); pose proof (ds_le_dl c (B j)); lra.
  - set (q := nearest c (B i)). set (f t := dl (mix t c q) (B j) - (1 - t) * ds c (B i)).
    destruct (intermediate f) as [t [T E]].
    + apply (lipschitz_continuous (ds c (B i) + ds c (B i))). apply lipschitz_minus.
      * intros s t. pose proof (dl_move (mix s c q) (mix t c q) (B j)) as M. rewrite dist_mix_mix in M.
        change (dist c q) with (ds c (B i)) in M. lra.
      * apply lipschitz_scale, ds_nonneg.
    + unfold f. rewrite mix_0. lra.
    + unfold f. pose proof (dl_nonneg (mix 1 c q) (B j)). lra.
    + unfold f in E. exists (mix t c q). set (x := mix t c q) in *.
      assert (X : ds x (B i) = (1 - t) * ds c (B i)) by (now apply ds_towards).
      pose proof (ds_le_dl x (B i)). pose proof (ds_le_dl x (B j)).
      assert (A : forall k, (k < N)%nat -> ds x (B i) <= dl x (B k)).
      { intros k K. destruct (Nat.eq_dec k i) as [-> | Di]; [lra |]. destruct (Nat.eq_dec k j) as [-> | Dj]; [lra |].
        destruct (H k K Di Dj). pose proof (dl_move c x (B k)) as M. unfold x in M at 1.
        rewrite dist_mix_left in M by lra. change (dist c q) with (ds c (B i)) in M. lra. }
      intros m _ [-> | ->] k K; pose proof (A k K); lra.
Qed.

(* Centres at equal distance from both rectangles suffice. *)
Lemma equal_distances_from N B i j c : (i < N)%nat -> ds c (B j) <= ds c (B i) -> others_allow N B i j c ->
  exists c', ds c' (B i) = ds c' (B j) /\ others_allow N B i j c'.
Proof.
  intros I L H. set (q := nearest c (B i)). set (f t := ds (mix t c q) (B j) - (1 - t) * ds c (B i)).
  destruct (intermediate f) as [t [T E]].
  - apply (lipschitz_continuous (ds c (B i) + ds c (B i))). apply lipschitz_minus.
    + intros s t. pose proof (ds_move (mix s c q) (mix t c q) (B j)) as M. rewrite dist_mix_mix in M.
      change (dist c q) with (ds c (B i)) in M. lra.
    + apply lipschitz_scale, ds_nonneg.
  - unfold f. rewrite mix_0. lra.
  - unfold f. pose proof (ds_nonneg (mix 1 c q) (B j)). lra.
  - unfold f in E. exists (mix t c q).
    assert (X : ds (mix t c q) (B i) = (1 - t) * ds c (B i)) by (now apply ds_towards).
    split; [lra |]. intros k K Di Dj. destruct (H k K Di Dj) as [A _].
    pose proof (dl_move c (mix t c q) (B k)) as M. rewrite dist_mix_left in M by lra.
    change (dist c q) with (ds c (B i)) in M. lra.
Qed.

Theorem equal_distances_suffice N B i j : (i < N)%nat -> (j < N)%nat ->
  (exists c, others_allow N B i j c) -> exists c, ds c (B i) = ds c (B j) /\ others_allow N B i j c.
Proof.
  intros I J [c H]. destruct (Rle_dec (ds c (B j)) (ds c (B i))) as [L | L].
  - now apply equal_distances_from with c.
  - destruct (equal_distances_from N B j i c) as [x [E X]]; [exact J | lra | |].
    + intros k K Dj Di. destruct (H k K Di Dj). now split.
    + exists x. split; [now symmetry |]. intros k K Di Dj. destruct (X k K Dj Di). now split.
Qed.

Theorem pair_possible N B i j : (i < N)%nat -> (j < N)%nat ->
  ((exists c, others_allow N B i j c) <-> (exists c, possible_at N B (pair i j) c)).
Proof.
  intros I J. split.
  - intros [c H]. destruct (Rle_dec (ds c (B j)) (ds c (B i))) as [L | L].
    + now apply move_to_farther with c.
    + destruct (move_to_farther N B j i c) as [x X]; [exact J | exact I | lra | |].
      * intros k K Dj Di. destruct (H k K Di Dj). now split.
      * exists x. intros m M [-> | ->]; (apply X; [assumption |]); [now right | now left].
  - intros [c H]. exists c. intros k K _ _. split; apply H; try assumption; [now left | now right].
Qed.

(* With the closure at infinity: possible iff a choice puts the pair on the boundary of an empty disc or half-plane. *)
Definition possible (N : nat) (B : sites) (i j : nat) : Prop :=
  (exists c, others_allow N B i j c) \/ (exists u, possible_far N B (pair i j) u).
Definition weak_edge (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  (exists c r, 0 < r /\ empty_disc N p (pair i j) c r) \/ (exists u m, empty_half_plane N p (pair i j) u m).

Theorem possible_exact N B i j : (i < N)%nat -> (j < N)%nat ->
  (possible N B i j <-> exists p, choice N B p /\ weak_edge N p i j).
Proof.
  intros I J. assert (E : exists k, (k < N)%nat /\ pair i j k) by (exists i; now split; [| left]).
  unfold possible, weak_edge. rewrite (pair_possible N B i j I J), (nerve N B _ E), (nerve_far N B _ E). split.
  - intros [[p [c [r [P [R0 D]]]]] | [p [u [m [P D]]]]]; exists p; (split; [exact P |]).
    + left. now exists c, r.
    + right. now exists u, m.
  - intros [p [P [[c [r [R0 D]]] | [u [m D]]]]].
    + left. now exists p, c, r.
    + right. now exists p, u, m.
Qed.

(* More information leaves fewer pairs possible. *)
Theorem possible_monotone N B' B i j : (i < N)%nat -> (j < N)%nat -> refined N B' B ->
  possible N B' i j -> possible N B i j.
Proof.
  intros I J F. rewrite !possible_exact by assumption. intros [p [P W]]. exists p. split; [| exact W].
  intros k K. apply F, P; exact K.
Qed.

(* The neighbours that bound the cells are possible pairs. *)
Lemma neighbours_are_possible N B i j : neighbours N B i j -> possible N B i j.
Proof. intros [c [Pi Pj]]. left. exists c. intros k K _ _. split; [now apply Pi | now apply Pj]. Qed.

(* So the possible pairs of i decide both of its cells. *)
Corollary int_by_possible_pairs N B i c : (i < N)%nat ->
  (int N B i c <-> forall j, (j < N)%nat -> j <> i -> possible N B i j -> dl c (B i) < ds c (B j)).
Proof.
  intros I. split.
  - intros H j J D _. now apply H.
  - intros H. apply int_by_neighbours; [exact I |]. intros j J D G. apply H; [exact J | exact D |].
    now apply neighbours_are_possible.
Qed.

Corollary pos_by_possible_pairs N B i c : (i < N)%nat ->
  (pos N B i c <-> forall j, (j < N)%nat -> j <> i -> possible N B i j -> ds c (B i) <= dl c (B j)).
Proof.
  intros I. split.
  - intros H j J _ _. now apply H.
  - intros H. apply pos_by_neighbours; [exact I |]. intros j J D G. apply H; [exact J | exact D |].
    now apply neighbours_are_possible.
Qed.

(* Where the boundaries of three cells come together, the two others are possible neighbours of each other. *)
Theorem joint_of_int N B i j k c : (forall l, (l < N)%nat -> l <> i -> dl c (B i) <= ds c (B l)) ->
  ds c (B j) = dl c (B i) -> ds c (B k) = dl c (B i) -> possible N B j k.
Proof.
  intros H Ej Ek. left. exists c. intros l L _ _. rewrite Ej, Ek.
  destruct (Nat.eq_dec l i) as [-> | D]; [lra |]. pose proof (H l L D). pose proof (ds_le_dl c (B l)). lra.
Qed.

Theorem joint_of_pos N B i j k c : (forall l, (l < N)%nat -> ds c (B i) <= dl c (B l)) ->
  dl c (B j) = ds c (B i) -> dl c (B k) = ds c (B i) -> possible N B j k.
Proof.
  intros H Ej Ek. left. exists c. intros l L _ _. pose proof (H l L).
  pose proof (ds_le_dl c (B j)). pose proof (ds_le_dl c (B k)). lra.
Qed.
