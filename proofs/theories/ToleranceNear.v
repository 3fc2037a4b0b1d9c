(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Only Delaunay neighbours of i or j bind the death of an edge ij [TOL-4]. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Cells Legal Orientation Disc TiedFace Path Tolerance.
Open Scope R_scope.

(* A property that holds near t for each of finitely many sites holds for all. *)
Lemma all_near N t (P : nat -> R -> Prop) : (forall k, (k < N)%nat -> near t (P k)) ->
  near t (fun s => forall k, (k < N)%nat -> P k s).
Proof.
  intros H. assert (X : near t (fun s => forall k, In k (seq 0 N) -> P k s)).
  { apply near_list. intros k K. apply H. apply in_seq in K. lia. }
  revert X. apply near_weaken. intros s Y k K. apply Y, in_seq. lia.
Qed.

Section Sites.
Variables (N : nat) (p : nat -> point).
Variable different : forall k l, (k < N)%nat -> (l < N)%nat -> k <> l -> p k <> p l.

(* The line through two places of a circle has no third one on it. *)
Lemma chord_ends o x y z : orient x y z = 0 -> x <> y -> dist2 o y = dist2 o x -> dist2 o z = dist2 o x -> z = x \/ z = y.
Proof.
  intros Z D Ey Ez. set (u := (snd y - snd x, - (fst y - fst x))).
  assert (U : u <> (0, 0)).
  { intros E. apply D. pose proof (f_equal fst E) as E1. pose proof (f_equal snd E) as E2. unfold u in E1, E2. simpl in E1, E2.
    rewrite (surjective_pairing x), (surjective_pairing y). f_equal; lra. }
  assert (Uy : dot u x = dot u y) by (unfold dot, u; simpl; ring).
  assert (Uz : dot u x = dot u z) by (unfold orient in Z; unfold dot, u; simpl; lra).
  destruct (across u x y U Uy) as [b Hb]. destruct (across u x z U Uz) as [a Ha].
  now apply (circle_meets_line o x (- snd u, fst u) a b y z (across_nonzero u U)).
Qed.

Lemma strict_edge_sym a b : strict_edge N p a b -> strict_edge N p b a.
Proof. intros [o [E H]]. exists o. split; [now symmetry |]. intros k K Db Da. rewrite <- E. now apply H. Qed.

(* A side of the polygon of the sites on an empty circle. *)
Lemma side_is_strict i j o r : (i < N)%nat -> (j < N)%nat -> i <> j -> dist o (p i) = r -> dist o (p j) = r ->
  (forall k, (k < N)%nat -> r <= dist o (p k)) ->
  (forall k, (k < N)%nat -> dist o (p k) = r -> 0 <= orient (p i) (p j) (p k)) -> strict_edge N p i j.
Proof.
  intros I J Dij Ei Ej Out Left. set (X k := orient (p i) (p j) (p k)).
  set (w d := (fst o + d * (snd (p j) - snd (p i)), snd o - d * (fst (p j) - fst (p i)))).
  assert (F : forall d k, dist2 (w d) (p k) - dist2 (w d) (p i) = dist2 o (p k) - dist2 o (p i) + 2 * d * X k)
    by (intros d k; unfold dist2, w, X, orient; simpl; ring).
  assert (Xj : X j = 0) by (unfold X, orient; ring).
  assert (Sq : forall k, dist o (p k) = r -> dist2 o (p k) = dist2 o (p i)) by (intros k E; rewrite <- !dist_sq, E, Ei; ring).
  destruct (small_finite (fun k d => k <> i -> k <> j -> 0 < dist2 o (p k) - dist2 o (p i) + 2 * d * X k) N) as [e [E L]].
  { intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D];
      [| exists 1; split; [lra |]; intros d _ Di Dj; now elim D].
    destruct (Req_dec (dist o (p k)) r) as [On | Off].
    - exists 1. split; [lra |]. intros d D _ _. rewrite (Sq k On). assert (0 < X k); [| nra].
      destruct (Left k K On) as [G | Z]; [exact G | exfalso].
      destruct (chord_ends o (p i) (p j) (p k)) as [Y | Y]; auto; revert Y; now apply different.
    - set (z := dist2 o (p k) - dist2 o (p i)).
      assert (Z0 : dist2 o (p i) < dist2 o (p k)) by (apply dist_lt; pose proof (Out k K); lra). assert (0 < z) by (unfold z; lra).
      pose proof (Rabs_pos (X k)) as P. exists (z / (2 * Rabs (X k) + 1) / 2). split.
      { apply Rmult_lt_0_compat; [| lra]. apply Rdiv_lt_0_compat; lra. }
      intros d [D0 D1] _ _. assert (Y : z / (2 * Rabs (X k) + 1) * (2 * Rabs (X k) + 1) = z) by (field; lra).
      assert (0 < z / (2 * Rabs (X k) + 1)) by (apply Rdiv_lt_0_compat; lra).
      pose proof (Rle_abs (- X k)) as A. rewrite Rabs_Ropp in A. nra. }
  specialize (L e (conj E (Rle_refl e))). exists (w e). split.
  - apply dist_eq. pose proof (F e j) as Y. rewrite Xj, (Sq j Ej) in Y. lra.
  - intros k K Di Dj. apply dist_lt. pose proof (F e k). pose proof (L k K Di Dj). lra.
Qed.

(* A circle through three sites with all others strictly outside. *)
Lemma turns_off a b k o : (a < N)%nat -> (b < N)%nat -> (k < N)%nat -> a <> b -> a <> k -> b <> k ->
  dist2 o (p k) = dist2 o (p a) -> dist2 o (p b) = dist2 o (p a) ->
  (forall l, (l < N)%nat -> l <> a -> l <> b -> l <> k -> dist2 o (p a) < dist2 o (p l)) -> strict_edge N p a k.
Proof.
  intros A B K Dab Dak Dbk Ek Eb H. apply dist_eq in Ek, Eb. set (r := dist o (p a)) in *.
  assert (Who : forall l, (l < N)%nat -> l = a \/ l = b \/ l = k \/ r < dist o (p l)).
  { intros l L. destruct (Nat.eq_dec l a); [tauto |]. destruct (Nat.eq_dec l b); [tauto |].
    destruct (Nat.eq_dec l k); [tauto |]. right. right. right. now apply dist_lt, H. }
  assert (Out : forall l, (l < N)%nat -> r <= dist o (p l))
    by (intros l L; destruct (Who l L) as [-> | [-> | [-> | Y]]]; [unfold r | | |]; lra).
  destruct (Rle_dec 0 (orient (p a) (p k) (p b))) as [Y | Y].
  - apply (side_is_strict a k o r); auto. intros l L E.
    destruct (Who l L) as [-> | [-> | [-> | G]]]; [unfold orient | | unfold orient | exfalso]; lra.
  - apply strict_edge_sym, (side_is_strict k a o r); auto. intros l L E.
    destruct (Who l L) as [-> | [-> | [-> | G]]]; [unfold orient | unfold orient in * | unfold orient | exfalso]; lra.
Qed.

(* The open disc about c with p k on its circle holds p a and p b alone. It shrinks towards p k; p a is the last to leave. *)
Lemma last_leaves a b k c t : (a < N)%nat -> (b < N)%nat -> (k < N)%nat -> a <> b -> a <> k -> b <> k ->
  (forall l, (l < N)%nat -> l <> a -> l <> b -> dist c (p k) <= dist c (p l)) ->
  0 < t <= 1 -> dist (mix t c (p k)) (p a) = (1 - t) * dist c (p k) ->
  (1 - t) * dist c (p k) <= dist (mix t c (p k)) (p b) -> strict_edge N p a k.
Proof.
  intros A B K Dab Dak Dbk H T Ea Eb. set (r := dist c (p k)) in *. set (o := mix t c (p k)) in *.
  assert (R0 : 0 <= r) by apply dist_nonneg.
  assert (Ek : dist o (p k) = (1 - t) * r) by (unfold o; rewrite dist_mix_right by lra; reflexivity).
  assert (Far : forall l, (l < N)%nat -> l <> a -> l <> b -> l <> k -> dist2 o (p a) < dist2 o (p l)).
  { intros l L Da Db Dk. rewrite <- (dist_sq o (p a)), Ea. unfold o. rewrite dist2_sym, dist2_mix, !(dist2_sym (p l)).
    rewrite <- (dist_sq c (p k)). fold r. pose proof (H l L Da Db) as X.
    assert (r * r <= dist2 c (p l)) by (rewrite <- dist_sq; nra).
    assert (0 < dist2 (p k) (p l)).
    { rewrite <- dist_sq. pose proof (dist_pos (p k) (p l) (different k l K L (not_eq_sym Dk))). nra. }
    assert (0 < t * dist2 (p k) (p l)) by (apply Rmult_lt_0_compat; lra). nra. }
  destruct (Rle_lt_or_eq_dec _ _ Eb) as [Lt | Eq].
  - exists o. split; [lra |]. intros l L Da Dk. destruct (Nat.eq_dec l b) as [-> | Db]; [lra |].
    apply dist_lt. now apply Far.
  - apply turns_off with b o; try assumption; apply dist_eq; lra.
Qed.

Variables (i j : nat).
Variables (Hi : (i < N)%nat) (Hj : (j < N)%nat) (Dij : i <> j).

(* All others are farther from c than p i and p j: f(c) > 0. *)
Definition inside_both (c : point) : Prop := forall k, (k < N)%nat -> k <> i -> k <> j ->
  dist c (p i) < dist c (p k) /\ dist c (p j) < dist c (p k).

Theorem nearest_is_neighbour c k : inside_both c -> (k < N)%nat -> k <> i -> k <> j ->
  (forall l, (l < N)%nat -> l <> i -> l <> j -> dist c (p k) <= dist c (p l)) ->
  strict_edge N p i k \/ strict_edge N p j k.
Proof.
  intros C K Di Dj H. destruct (C k K Di Dj) as [Ci Cj]. set (r := dist c (p k)) in *.
  destruct (shrink c (p k) (p i)) as [t [T [Et Ft]]]; [fold r; lra |].
  destruct (shrink c (p k) (p j)) as [s [S [Es Fs]]]; [fold r; lra |]. fold r in Ft, Fs.
  assert (Nested : forall x y z, x <= y -> 0 <= x -> y <= 1 ->
    dist (mix x c (p k)) z = (1 - x) * r -> (1 - y) * r <= dist (mix y c (p k)) z).
  { intros x y z XY X0 Y1 E. pose proof (dist_triangle (mix x c (p k)) (mix y c (p k)) z) as D.
    rewrite dist_mix_mix, Rabs_minus_sym, Rabs_pos_eq in D by lra. fold r in D. lra. }
  assert (T0 : t <> 0). { intros Z. rewrite Z, mix_0 in *. fold r in Et. lra. }
  assert (S0 : s <> 0). { intros Z. rewrite Z, mix_0 in *. fold r in Es. lra. }
  destruct (Rle_dec s t) as [L | L].
  - left. apply last_leaves with j c t; auto; try lra; [fold r; lra |]. fold r. apply Nested with s; lra.
  - right. apply last_leaves with i c s; auto; try lra; [fold r; lra |]. fold r. apply Nested with t; lra.
Qed.

(* So neighbours decide f wherever it, or its like for them alone, is positive. *)
Variable S : nat -> Prop.
Variable neighbours : forall k, (k < N)%nat -> k <> i -> k <> j -> strict_edge N p i k \/ strict_edge N p j k -> S k.

Lemma side_continuous a b k l : continuity (fun t => dist (mix t a b) (p k) - dist (mix t a b) (p l)).
Proof.
  apply (lipschitz_continuous (dist a b + dist a b)). apply lipschitz_minus; apply lipschitz_dist.
Qed.

Lemma nearest_other c : (exists k, (k < N)%nat /\ k <> i /\ k <> j) -> exists m, (m < N)%nat /\ m <> i /\ m <> j /\
  forall l, (l < N)%nat -> l <> i -> l <> j -> dist c (p m) <= dist c (p l).
Proof.
  intros [k [K [Di Dj]]]. destruct (finite_min (fun k => k <> i /\ k <> j) (fun k => dist c (p k)) N) as [m [M [[A B] L]]].
  - now exists k.
  - exists m. split; [exact M |]. split; [exact A |]. split; [exact B |]. intros l Hl D E. now apply L.
Qed.

Lemma neighbours_enclose c : strict_edge N p i j ->
  (forall k, (k < N)%nat -> S k -> k <> i -> k <> j -> dist c (p i) < dist c (p k) /\ dist c (p j) < dist c (p k)) ->
  inside_both c.
Proof.
  intros [o [Eo Ho]] C. set (x t := mix t o c).
  assert (E1 : x 1 = c) by apply mix_1. rewrite <- E1.
  assert (Along : forall t, 0 <= t <= 1 -> forall k, (k < N)%nat -> S k -> k <> i -> k <> j ->
    dist (x t) (p i) < dist (x t) (p k) /\ dist (x t) (p j) < dist (x t) (p k)).
  { intros t T k K Sk Di Dj. pose proof (Ho k K Di Dj). destruct (C k K Sk Di Dj).
    split; apply nearer_convex; try assumption; lra. }
  apply (open_closed (fun t => inside_both (x t))).
  - assert (E0 : x 0 = o) by apply mix_0. rewrite E0. intros k K Di Dj. pose proof (Ho k K Di Dj). lra.
  - intros t T I.
    assert (X : near t (fun s => forall k, (k < N)%nat -> k <> i -> k <> j ->
      dist (x s) (p i) < dist (x s) (p k) /\ dist (x s) (p j) < dist (x s) (p k))).
    { apply all_near. intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
      - destruct (I k K Di Dj) as [Ii Ij].
        pose proof (near_and _ _ _ (near_positive _ t (side_continuous o c k i) (Rlt_Rminus _ _ Ii))
          (near_positive _ t (side_continuous o c k j) (Rlt_Rminus _ _ Ij))) as Y.
        revert Y. apply near_weaken. intros s [Y1 Y2] _ _. unfold x. lra.
      - exists 1. split; [lra |]. intros s _ Di Dj. now elim D. }
    destruct X as [e [E G]]. exists e. split; [exact E |]. intros s Hs _. exact (G s Hs).
  - intros t T Ni.
    assert (Bad : exists k h, (k < N)%nat /\ k <> i /\ k <> j /\ (h = i \/ h = j) /\ dist (x t) (p k) <= dist (x t) (p h)).
    { apply NNPP. intros H. apply Ni. intros k K Di Dj. split; apply Rnot_le_lt; intros L; apply H;
        [exists k, i | exists k, j]; tauto. }
    destruct Bad as [k [h [K [Di [Dj [Eh Lk]]]]]].
    assert (X : near t (fun s => forall l, (l < N)%nat -> S l -> l <> i -> l <> j -> dist (x s) (p k) < dist (x s) (p l))).
    { apply all_near. intros l L. destruct (classic (S l /\ l <> i /\ l <> j)) as [[Sl [Dli Dlj]] | D].
      - destruct (Along t T l L Sl Dli Dlj) as [A1 A2].
        assert (A : dist (x t) (p k) < dist (x t) (p l)) by (destruct Eh; subst h; lra).
        pose proof (near_positive _ t (side_continuous o c l k) (Rlt_Rminus _ _ A)) as Y.
        revert Y. apply near_weaken. intros s Y _ _ _. unfold x. lra.
      - exists 1. split; [lra |]. intros s _ Sl Dli Dlj. now elim D. }
    destruct X as [e [E G]]. exists e. split; [exact E |]. intros s Hs _ I.
    destruct (nearest_other (x s)) as [m [M [Dmi [Dmj L]]]]; [now exists k |].
    pose proof (neighbours m M Dmi Dmj (nearest_is_neighbour (x s) m I M Dmi Dmj L)) as Sm.
    pose proof (G s Hs m M Sm Dmi Dmj). pose proof (L k K Di Dj). lra.
Qed.

Theorem neighbours_decide c v : strict_edge N p i j -> 0 < v ->
  (room N p i j S v c <-> room N p i j everybody v c).
Proof.
  intros E V. split.
  - intros H k K _ Di Dj.
    assert (I : inside_both c).
    { apply neighbours_enclose; [exact E |]. intros l L Sl Dli Dlj. destruct (H l L Sl Dli Dlj). lra. }
    destruct (nearest_other c) as [m [M [Dmi [Dmj L]]]]; [now exists k |].
    pose proof (neighbours m M Dmi Dmj (nearest_is_neighbour c m I M Dmi Dmj L)) as Sm.
    destruct (H m M Sm Dmi Dmj). pose proof (L k K Di Dj). lra.
  - intros H k K _ Di Dj. now apply H.
Qed.

(* The same supremum, so the same death. *)
Theorem neighbours_suffice w : strict_edge N p i j ->
  (is_lub (rooms N p i j S) w <-> is_lub (rooms N p i j everybody) w).
Proof.
  intros E.
  assert (Pos : exists v, 0 < v /\ rooms N p i j everybody v).
  { destruct E as [o [Eo Ho]].
    destruct (small_finite (fun k d => k <> i -> k <> j -> dist o (p i) + d <= dist o (p k)) N) as [d [D L]].
    { intros k K. destruct (classic (k <> i /\ k <> j)) as [[Di Dj] | D].
      - pose proof (Ho k K Di Dj). exists (dist o (p k) - dist o (p i)). split; [lra |]. intros. lra.
      - exists 1. split; [lra |]. intros d _ Di Dj. now elim D. }
    exists d. split; [exact D |]. exists o. intros k K _ Di Dj. pose proof (L d (conj D (Rle_refl d)) k K Di Dj). lra. }
  destruct Pos as [v0 [V0 R0]].
  assert (Same : forall v, 0 < v -> (rooms N p i j S v <-> rooms N p i j everybody v)).
  { intros v V. split; intros [c H]; exists c; now apply (neighbours_decide c v E V). }
  assert (Go : forall P Q : R -> Prop, (forall v, 0 < v -> (P v <-> Q v)) -> P v0 -> is_lub P w -> is_lub Q w).
  { intros P Q Eq P0 [Ub Lub]. split.
    - intros v Qv. destruct (Rlt_dec 0 v) as [V | V]; [now apply Ub, Eq |]. pose proof (Ub v0 P0). lra.
    - intros b B. apply Lub. intros v Pv. destruct (Rlt_dec 0 v) as [V | V]; [now apply B, Eq |].
      assert (v0 <= b) by now apply B, Eq. lra. }
  split; apply Go; try assumption.
  - now apply Same.
  - intros v V. symmetry. now apply Same.
Qed.
End Sites.

(* Any sites will do at whose best place no other site is nearer. *)
Theorem others_enough N p i j S w c : (forall v, rooms N p i j S v -> v <= w) -> room N p i j everybody w c ->
  is_lub (rooms N p i j everybody) w.
Proof.
  intros H R. split.
  - intros v [x X]. apply H. exists x. intros k K _ Di Dj. now apply X.
  - intros b B. apply B. now exists c.
Qed.
