(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Pairs that can change when the sites of C were narrowed and no other site [LOC-4]: B before, B' now. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Neighbours Nerve Legal Orientation Fan.
Open Scope R_scope.

Definition three (i j k : nat) (m : nat) : Prop := m = i \/ m = j \/ m = k.

(* A choice has the three on the circle of an empty disc, or on the border of an empty half-plane. *)
Definition possible_three (N : nat) (B : sites) (i j k : nat) : Prop :=
  (exists c, possible_at N B (three i j k) c) \/ (exists u, possible_far N B (three i j k) u).

Lemma three_possible N B i j k : (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> possible_three N B i j k ->
  possible N B i k /\ possible N B j k.
Proof.
  intros I J K [[c H] | [u [U H]]].
  - split; apply neighbours_are_possible; exists c; split; apply H; unfold three; auto.
  - split; right; exists u; (split; [exact U |]); intros v w V T W; apply H; auto; destruct T; unfold three; auto.
Qed.

(* At equal distances. *)
Lemma three_at N B B' (C : nat -> Prop) i j c : (i < N)%nat -> (j < N)%nat -> refined N B' B ->
  (forall k, (k < N)%nat -> ~ C k -> B' k = B k) -> ~ C i -> ~ C j ->
  ds c (B i) = ds c (B j) -> others_allow N B i j c -> ~ others_allow N B' i j c ->
  exists k, (k < N)%nat /\ C k /\ k <> i /\ k <> j /\ dl c (B' k) < ds c (B i) /\ possible_at N B (three i j k) c.
Proof.
  intros I J F Same Ci Cj E O Not. apply not_all_ex_not in Not as [k Not]. apply imply_to_and in Not as [K Not].
  apply imply_to_and in Not as [Ki Not]. apply imply_to_and in Not as [Kj Not].
  rewrite (Same i I Ci), (Same j J Cj), <- E in Not. assert (L : dl c (B' k) < ds c (B i)) by lra.
  exists k. split; [exact K |]. split; [| split; [exact Ki |]; split; [exact Kj |]; split; [exact L |]].
  - apply NNPP. intros Ck. rewrite (Same k K Ck) in L. destruct (O k K Ki Kj). lra.
  - assert (All : forall m, (m < N)%nat -> ds c (B i) <= dl c (B m)).
    { intros m M. destruct (Nat.eq_dec m i) as [-> | Mi];
        [pose proof (le_dl c _ _ (nearest_inside c (B i))) as X; exact X |].
      destruct (Nat.eq_dec m j) as [-> | Mj]; [rewrite E; exact (le_dl c _ _ (nearest_inside c (B j))) |].
      now destruct (O m M Mi Mj). }
    intros v V [-> | [-> | ->]] m M.
    + now apply All.
    + rewrite <- E. now apply All.
    + pose proof (ds_monotone c _ _ (F k K)). pose proof (le_dl c _ _ (nearest_inside c (B' k))) as X.
      fold (ds c (B' k)) in X. pose proof (All m M). lra.
Qed.

(* In direction u one of the two is higher: a centre far out. *)
Lemma not_so_far N B i j u : (i < N)%nat -> (j < N)%nat -> possible_far N B (pair i j) u ->
  dot u (highest u (B i)) < dot u (highest u (B j)) -> exists c, others_allow N B i j c.
Proof.
  intros I J [U H] L. set (q := highest u (B i)) in *. set (h := highest u (B j)) in *.
  set (e := dot u h - dot u q). assert (E0 : 0 < e) by (unfold e; lra).
  set (t := dist2 q h / (2 * e) + 1).
  assert (T : dist2 q h < 2 * t * e).
  { unfold t. replace (2 * (dist2 q h / (2 * e) + 1) * e) with (dist2 q h + 2 * e) by (field; lra). lra. }
  assert (T0 : 0 < t) by (pose proof (dist2_nonneg q h); nra).
  set (c := (fst q + t * fst u, snd q + t * snd u)).
  assert (D : forall z, dist2 c z - dist2 c q = dist2 q z - 2 * t * (dot u z - dot u q))
    by (intros; unfold c, dist2, dot; simpl; ring).
  assert (Di : ds c (B i) <= dist c q) by (apply ds_le; apply highest_spec).
  assert (Dj : ds c (B j) <= dist c q).
  { apply Rle_trans with (dist c h); [apply ds_le; apply highest_spec |]. left. apply dist_lt.
    pose proof (D h) as Dh. fold e in Dh. lra. }
  exists c. intros k K _ _. assert (Dk : dist c q <= dl c (B k)); [| split; lra].
  destruct (lowest_spec u (B k)) as [In _]. apply Rle_trans with (dist c (lowest u (B k))); [| now apply le_dl].
  apply dist_le. pose proof (D (lowest u (B k))) as Dl. pose proof (H i k I (or_introl eq_refl) K) as Low.
  fold q in Low.
  pose proof (dist2_nonneg q (lowest u (B k))).
  assert (0 <= 2 * t * (dot u q - dot u (lowest u (B k)))) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma allow_other_way N B i j c : others_allow N B i j c -> others_allow N B j i c.
Proof. intros O k K Kj Ki. destruct (O k K Ki Kj). now split. Qed.

Section Narrowed.
Variables (N : nat) (B B' : sites) (C : nat -> Prop).
Variable fewer : refined N B' B.
Variable same : forall k, (k < N)%nat -> ~ C k -> B' k = B k.

(* (1) A pair that is possible no longer. *)
Theorem possible_ends i j : (i < N)%nat -> (j < N)%nat -> ~ C i -> ~ C j -> possible N B i j -> ~ possible N B' i j ->
  (forall z, inside z (B i) -> ~ inside z (B j)) /\
  exists k, (k < N)%nat /\ C k /\ possible_three N B i j k /\ possible N B i k /\ possible N B j k /\
    (forall z, inside z (B' k) -> ~ inside z (B i) /\ ~ inside z (B j)).
Proof.
  intros I J Ci Cj P Not. split.
  { intros z Zi Zj. apply Not. left. exists z. intros k K _ _. rewrite (same i I Ci), (same j J Cj).
    pose proof (ds_le z _ _ Zi) as X. pose proof (ds_le z _ _ Zj) as Y. rewrite dist_self in X, Y.
    pose proof (dl_nonneg z (B' k)). lra. }
  assert (Finite : (exists c, others_allow N B i j c) -> exists k, (k < N)%nat /\ C k /\
    possible_three N B i j k /\ (forall z, inside z (B' k) -> ~ inside z (B i) /\ ~ inside z (B j))).
  { intros Ex. destruct (equal_distances_suffice N B i j I J Ex) as [c [E O]].
    destruct (three_at N B B' C i j c I J fewer same Ci Cj E O) as [k [K [Ck [Ki [Kj [L T]]]]]].
    { intros O'. apply Not. left. now exists c. }
    exists k. split; [exact K |]. split; [exact Ck |]. split; [left; now exists c |]. intros z Z.
    pose proof (le_dl c _ _ Z). split; intros In; pose proof (ds_le c _ _ In); lra. }
  assert (Found : exists k, (k < N)%nat /\ C k /\ possible_three N B i j k /\
    (forall z, inside z (B' k) -> ~ inside z (B i) /\ ~ inside z (B j))).
  { destruct P as [P | [u P]]; [now apply Finite |].
    destruct (Rtotal_order (dot u (highest u (B i))) (dot u (highest u (B j)))) as [L | [L | L]].
    - apply Finite. now apply (not_so_far N B i j u).
    - assert (Not' : ~ possible_far N B' (pair i j) u) by (intros X; apply Not; right; now exists u).
      destruct P as [U H]. assert (Ex : exists k, (k < N)%nat /\ dot u (highest u (B i)) < dot u (lowest u (B' k))).
      { apply NNPP. intros None. apply Not'. split; [exact U |]. intros v k V T K. apply Rnot_lt_le. intros X.
        apply None.
        exists k. split; [exact K |]. destruct T as [-> | ->]; [now rewrite <- (same i I Ci) |].
        rewrite L, <- (same j J Cj). exact X. }
      destruct Ex as [k [K X]]. exists k. split; [exact K |].
      assert (Low : dot u (lowest u (B' k)) <= dot u (highest u (B k))).
      { apply (proj2 (highest_spec u (B k))), (fewer k K). apply lowest_spec. }
      split; [| split].
      + apply NNPP. intros Ck. rewrite (same k K Ck) in X. pose proof (H i k I (or_introl eq_refl) K). lra.
      + right. exists u. split; [exact U |]. intros v m V [-> | [-> | ->]] M.
        * now apply (H i m I (or_introl eq_refl)).
        * now apply (H j m J (or_intror eq_refl)).
        * pose proof (H i m I (or_introl eq_refl) M). lra.
      + intros z Z. pose proof (proj2 (lowest_spec u (B' k)) z Z).
        split; intros In; pose proof (proj2 (highest_spec u _) z In); lra.
    - apply Finite. destruct (not_so_far N B j i u J I) as [c O]; [| exact L | exists c; now apply allow_other_way].
      destruct P as [U H]. split; [exact U |]. intros v k V [-> | ->]; apply H; unfold pair; auto. }
  destruct Found as [k [K [Ck [T D]]]]. destruct (three_possible N B i j k I J K T). exists k. tauto.
Qed.

(* (2) A pair that has a witness now. *)
Theorem witness_begins i j c : (i < N)%nat -> (j < N)%nat -> ~ C i -> ~ C j -> ~ legal N B i j ->
  witness N B' i j c -> exists k, (k < N)%nat /\ C k /\ (possible N B k i \/ possible N B k j).
Proof.
  intros I J Ci Cj Not W. assert (NotW : ~ witness N B i j c) by (intros X; apply Not; now exists c).
  apply not_all_ex_not in NotW as [k X]. apply imply_to_and in X as [K X]. apply imply_to_and in X as [Ki X].
  apply imply_to_and in X as [Kj X]. set (r := Rmax (dl c (B i)) (dl c (B j))).
  assert (Rk : ds c (B k) <= r).
  { apply Rnot_lt_le. intros L. apply X. pose proof (Rmax_l (dl c (B i)) (dl c (B j))).
    pose proof (Rmax_r (dl c (B i)) (dl c (B j))). unfold r in L. split; lra. }
  assert (Far : forall m, (m < N)%nat -> m <> i -> m <> j -> forall z, inside z (B' m) -> r < dist c z).
  { intros m M Mi Mj z Z. destruct (W m M Mi Mj) as [A H]. rewrite (same i I Ci) in A. rewrite (same j J Cj) in H.
    pose proof (ds_le c _ _ Z). unfold r. apply Rmax_lub_lt; lra. }
  exists k. split; [exact K |]. split.
  { apply NNPP. intros Ck. pose proof (Far k K Ki Kj (nearest c (B' k)) (nearest_inside _ _)) as L.
    rewrite (same k K Ck) in L. unfold ds in Rk. lra. }
  set (a := nearest c (B k)). set (x := nearest c (B i)). set (y := nearest c (B j)).
  assert (Ra : dist c a <= r) by exact Rk.
  assert (Rx : dist c x <= r) by (eapply Rle_trans; [apply le_dl, nearest_inside | apply Rmax_l]).
  assert (Ex : exists o s, dist o a = s /\ dist o x = s /\ forall z, r < dist c z -> s < dist o z).
  { destruct (Rle_dec (dist c x) (dist c a)) as [L | L].
    - destruct (shrink c a x L) as [t [T [E1 E2]]]. exists (mix t c a), ((1 - t) * dist c a).
      split; [exact E2 |]. split; [now rewrite <- E1 |]. intros z Z. now apply (shrunken_misses c a t r z).
    - destruct (shrink c x a) as [t [T [E1 E2]]]; [lra |]. exists (mix t c x), ((1 - t) * dist c x).
      split; [now rewrite <- E1 |]. split; [exact E2 |]. intros z Z. now apply (shrunken_misses c x t r z). }
  destruct Ex as [o [s [Oa [Ox Out]]]].
  assert (Ia : inside a (B k)) by apply nearest_inside. assert (Ix : inside x (B i)) by apply nearest_inside.
  assert (Iy : inside y (B j)) by apply nearest_inside.
  destruct (Rle_dec s (dist o y)) as [L | L].
  - left. left. exists o. intros m M Mk Mi. pose proof (ds_le o _ _ Ia). pose proof (ds_le o _ _ Ix).
    assert (s <= dl o (B m)); [| split; lra]. destruct (Nat.eq_dec m j) as [-> | Mj].
    + pose proof (le_dl o _ _ Iy). lra.
    + pose proof (Out _ (Far m M Mi Mj _ (nearest_inside c (B' m)))).
      pose proof (le_dl o _ _ (fewer m M _ (nearest_inside c (B' m)))). lra.
  - right. destruct (shrink o a y) as [t [T [E1 E2]]]; [lra |]. set (w := mix t o a) in *. left. exists w.
    intros m M Mk Mj. pose proof (ds_le w _ _ Ia). pose proof (ds_le w _ _ Iy). rewrite Oa in E2.
    assert ((1 - t) * s <= dl w (B m)); [| split; lra]. destruct (Nat.eq_dec m i) as [-> | Mi].
    + pose proof (le_dl w _ _ Ix). pose proof (dist_triangle o w x) as Tr. unfold w in Tr at 1.
      rewrite dist_mix_left, Oa in Tr by lra. lra.
    + pose proof (le_dl w _ _ (fewer m M _ (nearest_inside c (B' m)))).
      pose proof (shrunken_misses o a t s _ T ltac:(lra) (Out _ (Far m M Mi Mj _ (nearest_inside c (B' m))))) as S.
      rewrite Oa in S. fold w in S. lra.
Qed.

(* A disc with all of two sites inside holds a smaller one with a point of each on its circle. *)
Lemma shrunken_witness i j c p q : (i < N)%nat -> (j < N)%nat -> ~ C i -> ~ C j -> witness N B' i j c ->
  inside p (B i) -> inside q (B j) -> exists o s, dist o p = s /\ dist o q = s /\
  forall m z, (m < N)%nat -> m <> i -> m <> j -> inside z (B' m) -> s < dist o z.
Proof.
  intros I J Ci Cj W P Q.
  assert (Far : forall m z, (m < N)%nat -> m <> i -> m <> j -> inside z (B' m) -> dist c p < dist c z /\ dist c q < dist c z).
  { intros m z M Mi Mj Z. destruct (W m M Mi Mj) as [X Y]. rewrite (same i I Ci) in X. rewrite (same j J Cj) in Y.
    pose proof (le_dl c _ _ P). pose proof (le_dl c _ _ Q). pose proof (ds_le c _ _ Z). lra. }
  destruct (Rle_dec (dist c q) (dist c p)) as [L | L].
  - destruct (shrink c p q L) as [t [T [E F]]]. exists (mix t c p), ((1 - t) * dist c p).
    split; [exact F |]. split; [now rewrite <- E |]. intros m z M Mi Mj Z.
    apply shrunken_misses with (r := dist c p); [exact T | lra | now apply (Far m z M Mi Mj Z)].
  - destruct (shrink c q p) as [t [T [E F]]]; [lra |]. exists (mix t c q), ((1 - t) * dist c q).
    split; [now rewrite <- E |]. split; [exact F |]. intros m z M Mi Mj Z.
    apply shrunken_misses with (r := dist c q); [exact T | lra | now apply (Far m z M Mi Mj Z)].
Qed.

(* Who came into it before was on that circle for some choice, with both. *)
Lemma reached_possible i j k o s p q : (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> k <> i -> k <> j ->
  inside p (B i) -> inside q (B j) -> dist o p = s -> dist o q = s ->
  (forall m z, (m < N)%nat -> m <> i -> m <> j -> inside z (B' m) -> s < dist o z) -> ds o (B k) <= s ->
  C k /\ possible N B i k /\ possible N B j k.
Proof.
  intros I J K Ki Kj P Q Ep Eq Far L. split.
  - apply NNPP. intros Ck. pose proof (Far k (nearest o (B' k)) K Ki Kj (nearest_inside _ _)) as X.
    rewrite (same k K Ck) in X. unfold ds in L. lra.
  - assert (Low : forall m, (m < N)%nat -> s <= dl o (B m)).
    { intros m M. destruct (Nat.eq_dec m i) as [-> | Mi]; [rewrite <- Ep; now apply le_dl |].
      destruct (Nat.eq_dec m j) as [-> | Mj]; [rewrite <- Eq; now apply le_dl |].
      pose proof (Far m _ M Mi Mj (nearest_inside o (B' m))).
      pose proof (le_dl o _ _ (fewer m M _ (nearest_inside o (B' m)))). lra. }
    apply (three_possible N B i j k I J K). left. exists o.
    pose proof (ds_le o _ _ P). pose proof (ds_le o _ _ Q).
    intros v V [-> | [-> | ->]] m M; pose proof (Low m M); lra.
Qed.

(* When no narrowed site is possibly an edge with both: a pair of points that is legal now was legal before, *)
Theorem points_were_legal i j p q : (i < N)%nat -> (j < N)%nat -> ~ C i -> ~ C j ->
  (forall z, inside z (B i) -> z = p) -> (forall z, inside z (B j) -> z = q) ->
  (forall k, (k < N)%nat -> C k -> possible N B i k -> ~ possible N B j k) -> legal N B' i j -> legal N B i j.
Proof.
  intros I J Ci Cj Pi Pj None [c W].
  assert (Ip : inside p (B i)) by (rewrite <- (Pi _ (nearest_inside c (B i))); apply nearest_inside).
  assert (Iq : inside q (B j)) by (rewrite <- (Pj _ (nearest_inside c (B j))); apply nearest_inside).
  destruct (shrunken_witness i j c p q I J Ci Cj W Ip Iq) as (o & s & Ep & Eq & Far).
  exists o. intros k K Ki Kj. assert (L : s < ds o (B k)).
  { apply Rnot_le_lt. intros L.
    destruct (reached_possible i j k o s p q I J K Ki Kj Ip Iq Ep Eq Far L) as (Ck & P & Q). exact (None k K Ck P Q). }
  unfold dl. rewrite (Pi _ (farthest_inside o (B i))), (Pj _ (farthest_inside o (B j))). lra.
Qed.

(* and a pair of rectangles was an edge of every choice, with whatever witnesses. *)
Theorem edge_was_sure i j p : (i < N)%nat -> (j < N)%nat -> ~ C i -> ~ C j -> choice N B p ->
  (forall k, (k < N)%nat -> C k -> possible N B i k -> ~ possible N B j k) -> legal N B' i j -> strict_edge N p i j.
Proof.
  intros I J Ci Cj P None [c W].
  destruct (shrunken_witness i j c (p i) (p j) I J Ci Cj W (P i I) (P j J)) as (o & s & Ei & Ej & Far).
  exists o. split; [lra |]. intros k K Ki Kj. rewrite Ei. apply Rnot_le_lt. intros L.
  pose proof (ds_le o _ _ (P k K)).
  destruct (reached_possible i j k o s (p i) (p j) I J K Ki Kj (P i I) (P j J) Ei Ej Far ltac:(lra)) as (Ck & Q & R).
  exact (None k K Ck Q R).
Qed.

(* and a site that is a sure vertex of the hull now. *)
Theorem sure_begins v : (v < N)%nat -> ~ C v -> ~ sure_hull N B v -> sure_hull N B' v ->
  exists k, (k < N)%nat /\ C k /\ possible N B k v.
Proof.
  intros V Cv Not [u Su].
  assert (NotU : ~ forall k x y, (k < N)%nat -> k <> v -> inside x (B v) -> inside y (B k) -> dot u y < dot u x)
    by (intros X; apply Not; now exists u).
  apply not_all_ex_not in NotU as [k X]. apply not_all_ex_not in X as [x X]. apply not_all_ex_not in X as [y X].
  apply imply_to_and in X as [K X]. apply imply_to_and in X as [Kv X]. apply imply_to_and in X as [Ix X].
  apply imply_to_and in X as [Iy L]. rewrite (same v V Cv) in Su. apply Rnot_lt_le in L.
  assert (Below : forall m, (m < N)%nat -> m <> v -> dot u (lowest u (B m)) < dot u x).
  { intros m M Mv. pose proof (Su m x _ M Mv Ix (nearest_inside x (B' m))).
    pose proof (proj2 (lowest_spec u (B m)) _ (fewer m M _ (nearest_inside x (B' m)))). lra. }
  exists k. split; [exact K |]. split.
  { apply NNPP. intros Ck. pose proof (Su k x y K Kv Ix). rewrite (same k K Ck) in H. specialize (H Iy). lra. }
  right. exists u. split.
  { intros U. pose proof (Su k x _ K Kv Ix (nearest_inside x (B' k))) as Q. rewrite U in Q. unfold dot in Q. simpl in Q.
    lra. }
  pose proof (proj2 (highest_spec u (B v)) x Ix). pose proof (proj2 (highest_spec u (B k)) y Iy).
  pose proof (proj2 (lowest_spec u (B v)) x Ix).
  intros w m _ [-> | ->] M; (destruct (Nat.eq_dec m v) as [-> | Mv]; [| pose proof (Below m M Mv)]); lra.
Qed.
End Narrowed.
