(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Gabriel graphs of all choices [GAB-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Nerve NearGraph.
Open Scope R_scope.

(* Positive outside of the circle with xy as its diameter, negative inside. *)
Definition angle (z x y : point) : R := (fst z - fst x) * (fst z - fst y) + (snd z - snd x) * (snd z - snd y).
Definition gabriel (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  forall k, (k < N)%nat -> k <> i -> k <> j -> 0 <= angle (p k) (p i) (p j).
Definition strictly_gabriel (N : nat) (p : nat -> point) (i j : nat) : Prop :=
  forall k, (k < N)%nat -> k <> i -> k <> j -> 0 < angle (p k) (p i) (p j).

Lemma angle_of_middle z m v : angle z (fst m - fst v, snd m - snd v) (fst m + fst v, snd m + snd v) =
  dist2 m z - dot v v.
Proof. unfold angle, dist2, dot. simpl. ring. Qed.

(* Among those in the disc, closed or open, one makes a possible pair with i: shrink the disc towards p i. In numbers:
   the least t with a point on the circle about mix t x y, through x; t = |z - x|^2 / (2 (z - x).(y - x) ...). *)
Definition share (x y z : point) : R := dist2 x z / ((fst z - fst x) * (fst y - fst x) + (snd z - snd x) * (snd y - snd x)).

Lemma angle_share z x y : angle z x y = dist2 x z - ((fst z - fst x) * (fst y - fst x) + (snd z - snd x) * (snd y - snd x)).
Proof. unfold angle, dist2. ring. Qed.

(* With s the share, the circle with x and mix s x y as diameter goes through z. *)
Lemma disc_of_share x y t z : dist2 (mix (t / 2) x y) z - dist2 (mix (t / 2) x y) x =
  dist2 x z - t * ((fst z - fst x) * (fst y - fst x) + (snd z - snd x) * (snd y - snd x)).
Proof. unfold dist2, mix. simpl. field. Qed.

Lemma someone_possible N B p i j (S : nat -> Prop) : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  (exists k, (k < N)%nat /\ k <> i /\ k <> j /\ S k) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> S k -> angle (p k) (p i) (p j) <= 0) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> ~ S k -> 0 <= angle (p k) (p i) (p j)) ->
  exists k, (k < N)%nat /\ k <> i /\ k <> j /\ S k /\ possible N B i k.
Proof.
  intros I J P [a [A [Ai [Aj Sa]]]] In Out.
  set (w k := (fst (p k) - fst (p i)) * (fst (p j) - fst (p i)) + (snd (p k) - snd (p i)) * (snd (p j) - snd (p i))).
  destruct (classic (exists k, (k < N)%nat /\ k <> i /\ k <> j /\ S k /\ p k = p i)) as [[k [K [Ki [Kj [Sk E]]]]] | Apart].
  { exists k. repeat split; try assumption. apply (disc_possible N B p i k (p i) 0 I K P). split.
    - intros m _ [-> | ->]; [apply dist_self | rewrite E; apply dist_self].
    - intros m _. apply dist_nonneg. }
  assert (Pos : forall k, (k < N)%nat -> k <> i -> k <> j -> S k -> 0 < dist2 (p i) (p k) /\ dist2 (p i) (p k) <= w k).
  { intros k K Ki Kj Sk. split.
    - rewrite <- dist_sq. assert (p i <> p k) as D by (intros E; apply Apart; exists k; repeat split; auto).
      pose proof (dist_pos _ _ D). nra.
    - pose proof (In k K Ki Kj Sk) as Q. rewrite angle_share in Q. unfold w. lra. }
  destruct (finite_min (fun k => k <> i /\ k <> j /\ S k) (fun k => share (p i) (p j) (p k)) N) as [m [M [[Mi [Mj Sm]] L]]].
  { now exists a. }
  exists m. repeat split; try assumption. destruct (Pos m M Mi Mj Sm) as [Dm Wm].
  set (t := share (p i) (p j) (p m)) in *. assert (T : t * w m = dist2 (p i) (p m)) by (unfold t, share; fold (w m); field; lra).
  assert (T0 : 0 < t) by (unfold t, share; fold (w m); apply Rdiv_lt_0_compat; lra).
  assert (T1 : t <= 1) by nra.
  apply (disc_possible N B p i m (mix (t / 2) (p i) (p j)) (dist (mix (t / 2) (p i) (p j)) (p i)) I M P). split.
  - intros k _ [-> | ->]; [reflexivity |]. apply dist_eq. pose proof (disc_of_share (p i) (p j) t (p m)) as Q. fold (w m) in Q. lra.
  - intros k K. apply dist_le. pose proof (disc_of_share (p i) (p j) t (p k)) as Q. fold (w k) in Q.
    destruct (Nat.eq_dec k i) as [-> | Ki]; [lra |]. pose proof (dist2_nonneg (p i) (p k)).
    destruct (Nat.eq_dec k j) as [-> | Kj].
    { assert (w j = dist2 (p i) (p j)) as E by (unfold w, dist2; ring). rewrite E in Q. nra. }
    destruct (classic (S k)) as [Sk | Sk].
    + destruct (Pos k K Ki Kj Sk) as [Dk Wk]. pose proof (L k K (conj Ki (conj Kj Sk))) as Lk. fold t in Lk.
      assert (share (p i) (p j) (p k) * w k = dist2 (p i) (p k)) by (unfold share; fold (w k); field; lra). nra.
    + pose proof (Out k K Ki Kj Sk) as O. rewrite angle_share in O. fold (w k) in O.
      destruct (Rle_lt_dec (w k) 0) as [Z | Z]; nra.
Qed.

(* A pair that is not in the graph has a site in its open disc that makes a possible pair with i. *)
Theorem gabriel_by_possible N B p i j : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  (gabriel N p i j <-> forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> 0 <= angle (p k) (p i) (p j)).
Proof.
  intros I J P. split; [intros H k K Ki Kj _; now apply H |]. intros H k K Ki Kj. apply Rnot_lt_le. intros C.
  destruct (someone_possible N B p i j (fun k => angle (p k) (p i) (p j) < 0) I J P) as [m [M [Mi [Mj [Sm Po]]]]];
    try (intros; lra); [now exists k |]. pose proof (H m M Mi Mj Po). lra.
Qed.

Theorem strictly_by_possible N B p i j : (i < N)%nat -> (j < N)%nat -> choice N B p ->
  (strictly_gabriel N p i j <->
   forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k -> 0 < angle (p k) (p i) (p j)).
Proof.
  intros I J P. split; [intros H k K Ki Kj _; now apply H |]. intros H k K Ki Kj. apply Rnot_le_lt. intros C.
  destruct (someone_possible N B p i j (fun k => angle (p k) (p i) (p j) <= 0) I J P) as [m [M [Mi [Mj [Sm Po]]]]];
    try (intros; lra); [now exists k |]. pose proof (H m M Mi Mj Po). lra.
Qed.

(* Surely an edge: the product is positive over all three rectangles, for each possible pair of i separately. *)
Theorem surely_gabriel N B i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  ((forall p, choice N B p -> strictly_gabriel N p i j) <->
   (forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k ->
     forall x y z, inside x (B i) -> inside y (B j) -> inside z (B k) -> 0 < angle z x y)).
Proof.
  intros I J D. split.
  - intros H k K Ki Kj _ x y z X Y Z.
    set (p := set_point (set_point (set_point (fun m => nearest x (B m)) k z) j y) i x).
    assert (P : choice N B p) by (repeat (apply set_choice; [| assumption]); apply choice_nearest).
    pose proof (H p P k K Ki Kj) as Q. unfold p in Q. rewrite set_same in Q. rewrite (set_other _ i x k Ki) in Q.
    rewrite (set_other _ j y k Kj), set_same in Q. rewrite (set_other _ i x j) in Q by congruence.
    now rewrite set_same in Q.
  - intros H p P. apply (strictly_by_possible N B p i j I J P). intros k K Ki Kj Po.
    apply (H k K Ki Kj Po); now apply P.
Qed.

(* Its least value: coordinate by coordinate, x and y at ends, z as near to their middle as can be. *)
Lemma least_of_side a b c d e f x y z : a <= x <= b -> c <= y <= d -> e <= z <= f -> exists x' y',
  (x' = a \/ x' = b) /\ (y' = c \/ y' = d) /\
  (clamp e f ((x' + y') / 2) - x') * (clamp e f ((x' + y') / 2) - y') <= (z - x) * (z - y).
Proof.
  intros X Y Z. assert (Ex : exists x', (x' = a \/ x' = b) /\ (z - x') * (z - y) <= (z - x) * (z - y)).
  { destruct (Rle_lt_dec 0 (z - y)); [exists b | exists a]; (split; [tauto | nra]). }
  destruct Ex as [x' [Hx Lx]].
  assert (Ey : exists y', (y' = c \/ y' = d) /\ (z - x') * (z - y') <= (z - x') * (z - y)).
  { destruct (Rle_lt_dec 0 (z - x')); [exists d | exists c]; (split; [tauto | nra]). }
  destruct Ey as [y' [Hy Ly]]. exists x', y'. split; [exact Hx |]. split; [exact Hy |].
  destruct (clamp_spec e f ((x' + y') / 2)) as [_ Q]; [lra |]. specialize (Q z Z). nra.
Qed.

Theorem least_angle X Y Z x y z : inside x X -> inside y Y -> inside z Z -> exists x' y',
  (fst x' = xlo X \/ fst x' = xhi X) /\ (snd x' = ylo X \/ snd x' = yhi X) /\
  (fst y' = xlo Y \/ fst y' = xhi Y) /\ (snd y' = ylo Y \/ snd y' = yhi Y) /\
  angle (nearest (mix (/ 2) x' y') Z) x' y' <= angle z x y.
Proof.
  intros [X1 X2] [Y1 Y2] [Z1 Z2].
  destruct (least_of_side _ _ _ _ _ _ _ _ _ X1 Y1 Z1) as [a [b [A [C L]]]].
  destruct (least_of_side _ _ _ _ _ _ _ _ _ X2 Y2 Z2) as [c [d [A' [C' L']]]].
  exists (a, c), (b, d). simpl. repeat split; try assumption. unfold angle, nearest, mix. simpl.
  replace ((1 - / 2) * a + / 2 * b) with ((a + b) / 2) by field.
  replace ((1 - / 2) * c + / 2 * d) with ((c + d) / 2) by field. lra.
Qed.

(* Possibly: m is the middle of points of both, and no site need be in the least disc about it. *)
Definition stretch (a b c d t : R) : R := Rmax (Rabs (t - clamp a b t)) (Rabs (t - clamp c d t)).
Definition least_radius2 (X Y : rect) (m : point) : R :=
  stretch (xlo X) (xhi X) (xlo Y) (xhi Y) (fst m) * stretch (xlo X) (xhi X) (xlo Y) (xhi Y) (fst m) +
  stretch (ylo X) (yhi X) (ylo Y) (yhi Y) (snd m) * stretch (ylo X) (yhi X) (ylo Y) (yhi Y) (snd m).

Lemma stretch_least a b c d s s' : a <= s <= b -> c <= s' <= d ->
  stretch a b c d ((s + s') / 2) * stretch a b c d ((s + s') / 2) <= (s' - s) / 2 * ((s' - s) / 2).
Proof.
  intros S S'. set (t := (s + s') / 2). unfold stretch. apply Rmax_case.
  - destruct (clamp_spec a b t) as [_ Q]; [lra |]. specialize (Q s S). rewrite <- Rabs_mult, Rabs_pos_eq by apply Rle_0_sqr.
    unfold t in *. lra.
  - destruct (clamp_spec c d t) as [_ Q]; [lra |]. specialize (Q s' S'). rewrite <- Rabs_mult, Rabs_pos_eq by apply Rle_0_sqr.
    unfold t in *. lra.
Qed.

Lemma clamp_cases lo hi t : lo <= hi ->
  (t <= lo /\ clamp lo hi t = lo) \/ (lo <= t <= hi /\ clamp lo hi t = t) \/ (hi <= t /\ clamp lo hi t = hi).
Proof. intros H. unfold clamp, Rmax, Rmin. destruct (Rle_dec hi t); destruct (Rle_dec lo _); lra. Qed.

Lemma stretch_attained a b c d s s' : a <= s <= b -> c <= s' <= d -> exists x y, a <= x <= b /\ c <= y <= d /\
  x + y = s + s' /\ (y - x) / 2 * ((y - x) / 2) = stretch a b c d ((s + s') / 2) * stretch a b c d ((s + s') / 2).
Proof.
  intros S S'. set (t := (s + s') / 2). assert (T : s + s' = 2 * t) by (unfold t; lra). unfold stretch.
  destruct (clamp_cases a b t) as [[P Ea] | [[P Ea] | [P Ea]]]; [lra | ..]; rewrite Ea;
    (destruct (clamp_cases c d t) as [[Q Ec] | [[Q Ec] | [Q Ec]]]; [lra | ..]; rewrite Ec);
    (match goal with |- context [Rmax (Rabs (?u - ?v)) (Rabs (?u - ?w))] =>
       destruct (Rle_dec (Rabs (u - w)) (Rabs (u - v))) as [G | G];
       [exists v, (2 * u - v) | exists (2 * u - w), w];
       (first [rewrite !Rmax_left by lra | rewrite !Rmax_right by lra]);
       rewrite <- Rabs_mult, (Rabs_pos_eq (_ * _)) by apply Rle_0_sqr;
       unfold Rabs in G; destruct (Rcase_abs (u - v)); destruct (Rcase_abs (u - w)); repeat split; lra end).
Qed.

Theorem possibly_gabriel N B i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  ((exists p, choice N B p /\ gabriel N p i j) <->
   (exists x y, inside x (B i) /\ inside y (B j) /\ let m := mix (/ 2) x y in
     forall k, (k < N)%nat -> k <> i -> k <> j -> possible N B i k ->
       least_radius2 (B i) (B j) m <= dl m (B k) * dl m (B k))).
Proof.
  intros I J D. assert (Mid : forall x y, mix (/ 2) x y = ((fst x + fst y) / 2, (snd x + snd y) / 2))
    by (intros; unfold mix; f_equal; field).
  assert (Ang : forall x y z, angle z x y = dist2 (mix (/ 2) x y) z -
    ((fst y - fst x) / 2 * ((fst y - fst x) / 2) + (snd y - snd x) / 2 * ((snd y - snd x) / 2)))
    by (intros; unfold angle, dist2, mix; simpl; field).
  split.
  - intros [p [P G]]. exists (p i), (p j). split; [now apply P |]. split; [now apply P |]. intros m k K Ki Kj _.
    pose proof (G k K Ki Kj) as Q. rewrite Ang in Q. fold m in Q.
    pose proof (le_dl m _ _ (P k K)) as L. pose proof (dist_nonneg m (p k)). pose proof (dist_sq m (p k)).
    destruct (P i I) as [X1 X2]. destruct (P j J) as [Y1 Y2].
    pose proof (stretch_least _ _ _ _ _ _ X1 Y1) as S1. pose proof (stretch_least _ _ _ _ _ _ X2 Y2) as S2.
    unfold least_radius2. unfold m at 1 2 3 4. rewrite Mid. simpl. nra.
  - intros [x [y [[X1 X2] [[Y1 Y2] H]]]]. cbv zeta in H. set (m := mix (/ 2) x y) in *.
    destruct (stretch_attained _ _ _ _ _ _ X1 Y1) as [a [b [A1 [B1 [E1 R1]]]]].
    destruct (stretch_attained _ _ _ _ _ _ X2 Y2) as [c [d [A2 [B2 [E2 R2]]]]].
    set (p := set_point (set_point (fun k => farthest m (B k)) j (b, d)) i (a, c)).
    assert (P : choice N B p).
    { apply set_choice; [| now split]. apply set_choice; [apply choice_farthest | now split]. }
    exists p. split; [exact P |]. apply (gabriel_by_possible N B p i j I J P). intros k K Ki Kj Po.
    assert (Pi : p i = (a, c)) by (unfold p; apply set_same).
    assert (Pj : p j = (b, d)) by (unfold p; rewrite set_other by congruence; apply set_same).
    assert (Pk : p k = farthest m (B k)) by (unfold p; rewrite set_other by exact Ki; now rewrite set_other by exact Kj).
    assert (Em : mix (/ 2) (p i) (p j) = m) by (unfold m; rewrite Pi, Pj, !Mid; simpl; f_equal; lra).
    rewrite Ang, Em, Pi, Pj, Pk. simpl. rewrite R1, R2. specialize (H k K Ki Kj Po).
    unfold least_radius2 in H. unfold m in H at 1 2 3 4. rewrite Mid in H. simpl in H. unfold dl in H. rewrite dist_sq in H. lra.
Qed.
